# What builds Coop in a checkout: packages, configuration, targets. Found nothing to build, it says nothing.

# Benchmarks and experiments are built when they are asked for.
programs_and_tests=(programs tests_unit tests_component tests_system)

packages_for() { # group...
  local group
  for group in "$@"; do awk -v group="$group" '$1 == group { print $2 }' "$here/cmake/packages.txt"; done
}

missing_packages() { # package...
  local installed
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
    awk '$2 == "installed" { print $1 }') || true
  comm -23 <(printf '%s\n' "$@" | sort -u) <(printf '%s\n' "$installed" | sort -u)
}

# Installs what is missing from Debian's packages of the groups named. Asks nothing.
need_packages() { # group...
  if ! command -v dpkg-query >/dev/null; then
    say 'not a Debian system: the packages in cmake/packages.txt are assumed to be there'
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages $(packages_for "$@"))
  [ "${#missing[@]}" -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || die "as root, please: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing from Debian: ${missing[*]}"
  mkdir -p "$here/build"
  if ! { "${as_root[@]}" apt-get update -q &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -q -y --no-install-recommends "${missing[@]}"; } >"$here/build/apt.log" 2>&1; then
    tail -n 20 "$here/build/apt.log" >&2
    die 'installing failed; all of it is in build/apt.log'
  fi
}

configure() {
  [ ! -f "$build/build.ninja" ] || return 0
  say "configuring ($preset)"
  local launcher=()
  # ccache handles sources with precompiled headers only when told to be less strict about macros.
  if command -v ccache >/dev/null; then
    launcher=('-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_SLOPPINESS=pch_defines,time_macros;ccache')
  fi
  mkdir -p "$build"
  if ! (cd "$here" && cmake --preset "$preset" "${launcher[@]}") >"$build/configure.log" 2>&1; then
    tail -n 30 "$build/configure.log" >&2
    rm -f "$build/build.ninja"
    die "configuring failed; all of it is in build/$preset/configure.log"
  fi
}

# A second start has nothing to do and says so. Ninja has no lock of its own, and two terminals may want to build at once.
prepare() { # target...
  need_packages build
  mkdir -p "$here/build"
  (
    flock 9
    configure
    cd "$build"
    NINJA_STATUS='[%f/%t %es] ' ninja -j "$jobs" "$@" >&2
  ) 9>"$build.lock"
}
