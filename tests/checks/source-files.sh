# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Shared by the checks. Source it with the current folder at the root of the tree.

# Whether git knows this tree; says why not, otherwise.
have_git() {
  if ! command -v git >/dev/null; then
    echo "git is not installed"
    return 1
  fi
  # The tree may belong to another user (a mounted folder): it is only read here.
  git() { command git -c safe.directory='*' "$@"; }
  if ! git rev-parse --git-dir >/dev/null 2>&1; then
    echo "this tree is no git checkout"
    return 1
  fi
}

# The tracked files with one of these endings, one a line; without git, those of the source folders.
source_files() { # glob...
  local glob names=()
  if have_git >/dev/null; then
    git ls-files -- "$@"
  else
    for glob in "$@"; do names+=(-o -name "$glob"); done
    find engine cli studio tests bench \( -false "${names[@]}" \) -type f 2>/dev/null | LC_ALL=C sort
  fi
}
