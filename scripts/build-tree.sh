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

# Configures when there is no build tree yet, or when the source tree was moved since; otherwise
# Ninja itself sees what has changed.
configure_tree() { # source preset folder
  local source=$1 preset=$2 folder=$3 home=
  if [[ -f $folder/build.ninja && -f $folder/CMakeCache.txt ]]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
    [[ $home != "$source" ]] || return 0
  fi
  (cd "$source" && cmake --fresh --preset "$preset") >"$folder/configure.log" 2>&1 || {
    cat "$folder/configure.log" >&2
    echo "Configuring the preset $preset failed (see above)." >&2
    return 1
  }
}

# Builds targets and shows one short line per step on stderr; quiet when nothing is to be done.
build_tree() { # source preset folder target...
  local source=$1 preset=$2 folder=$3
  shift 3
  mkdir -p "$folder" 2>/dev/null || {
    echo "Cannot write into $source; put the source tree where you may write." >&2
    return 1
  }
  ( # Two calls at once must not build the same files: the lock lives as long as this subshell.
    exec 9>"$folder/.lock"
    flock 9
    configure_tree "$source" "$preset" "$folder" || exit 1
    NINJA_STATUS='[%f/%t] ' cmake --build "$folder" -j "$(build_jobs)" --target "$@" 2>&1 9>&- |
      sed -u -E -e '/no work to do/d' -e '/Re-checking globbed directories/d' -e '/^-- /d' \
        -e 's/^(\[[0-9/]+\]) Building CXX object .*CMakeFiles\/[^/]*\.dir\/(.*)\.o$/\1 Compiling \2/' >&2
  )
}
