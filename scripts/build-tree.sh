# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Shared by ./run and ./test: configures and builds a preset.

# As many compilers at once as there are cores, and 2 GB of memory for each: CGAL is greedy.
build_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 2000000) }' /proc/meminfo 2>/dev/null || echo 1)
  ((memory >= 1)) || memory=1
  echo $((cores < memory ? cores : memory))
}

# Configures when there is no build tree yet, when the source tree was moved since, or when the tree
# has no tests and they are wanted; otherwise Ninja itself sees what has changed. Who only wants to
# run the command need not have the libraries of the tests.
configure_tree() { # source preset folder tests(ON|OFF)
  local source=$1 preset=$2 folder=$3 tests=$4 options=()
  if [[ ! -f $folder/build.ninja ]] ||
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source" "$folder/CMakeCache.txt"; then
    options=(--fresh)
    [[ $tests == ON ]] || options+=(-DTOILE_TESTS=OFF -DTOILE_BENCHMARKS=OFF)
  elif [[ $tests == OFF ]] || ! grep -qx 'TOILE_TESTS:BOOL=OFF' "$folder/CMakeCache.txt"; then
    return 0
  fi
  (cd "$source" && cmake --preset "$preset" "${options[@]}") >"$folder/configure.log" 2>&1 || {
    cat "$folder/configure.log" >&2
    echo "Configuring the preset $preset failed (see above)." >&2
    return 1
  }
}

# Builds targets and shows one short line per step on stderr; quiet when nothing is to be done.
build_tree() { # source preset folder tests(ON|OFF) target...
  local source=$1 preset=$2 folder=$3 tests=$4
  shift 4
  # So that a second checkout, elsewhere, finds in ccache what the first one compiled.
  export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$source}
  mkdir -p "$folder" 2>/dev/null || {
    echo "Cannot write into $source; put the source tree where you may write." >&2
    return 1
  }
  ( # Two calls at once must not build the same files: the lock lives as long as this subshell.
    exec 9>"$folder/.lock"
    flock 9
    configure_tree "$source" "$preset" "$folder" "$tests" || exit 1
    NINJA_STATUS='[%f/%t] ' cmake --build "$folder" -j "$(build_jobs)" --target "$@" 2>&1 9>&- |
      sed -u -E -e '/no work to do/d' -e '/Re-checking globbed directories/d' -e '/^-- /d' \
        -e 's/^(\[[0-9/]+\]) Building CXX object .*CMakeFiles\/[^/]*\.dir\/(.*)\.o$/\1 Compiling \2/' >&2
  )
}
