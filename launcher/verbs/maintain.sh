# Verbs for those who change Coop.

help_90_develop() {
  cat <<'TEXT'
Develop
  experiment casma [--seeds 500] [--seed 1] [--jobs 1] [-o DIR]
                        the CASMA paper's experiments, each table beside the paper's, and a report
  experiment planning [MAP...] [-o DIR]
                        grid planners on the MovingAI maps: optimal lengths, time a query, report;
                        then the speeds of searches and costmaps
  build [TARGET...]     install what is missing, configure, build (default: programs and tests;
                        all: benchmarks and experiments, too)
  install [lint] [package] [ci]
                        install the Debian packages that are missing, those of further tools too
  test [unit|component|system|all] [FILTER]
                        build and test; FILTER is a regular expression on the names of test programs
  bench [FILTER]        run the benchmarks; results also as JSON in build/release/bench/results
  format                format all C++ files
  lint [--tidy | --tidy-changed]
                        check their format; --tidy: clang-tidy as well, which takes long; or only on
                        what the last commits have changed
  package               build a Debian package in build/release

COOP_PRESET=debug|asan|tsan|core-only chooses another build than release.
TEXT
}

verb_build() { prepare "${@:-${programs_and_tests[@]}}"; }
verb_install() { need_packages build "$@"; }

sources() { (cd "$here" && find components launcher tests -name '*.cpp' -o -name '*.hpp' | sort); }

verb_format() {
  need_packages lint
  (cd "$here" && sources | xargs clang-format -i)
}

# What clang-tidy reads: all sources, or those among the last commits' changes, the newest first, at most forty.
tidy_sources() { # all|changed
  local all
  all=$(sources | grep '^\(components\|launcher\)/.*\.cpp$')
  if [ "$1" = all ]; then echo "$all"; return; fi
  (cd "$here" && git log -n 30 --format= --name-only 2>/dev/null | awk '!seen[$0]++' | grep -Fx "$all" | head -n 40)
}

# clang-tidy takes gcc's precompiled headers for its own and fails: it gets the compile commands without them.
tidy() { # all|changed
  local status=0
  prepare coop_idl
  mkdir -p "$build/tidy"
  sed 's/-Winvalid-pch -include [^ ]*cmake_pch\.hxx//' "$build/compile_commands.json" >"$build/tidy/compile_commands.json"
  tidy_sources "$1" >"$build/tidy/files"
  (cd "$here" && xargs -r -P "$jobs" -n 1 clang-tidy --quiet -p "$build/tidy" <"$build/tidy/files") \
    >"$build/tidy/log" 2>&1 || status=$?
  grep -v '^[0-9]* warnings\? \(and [0-9]* errors\? \)\?generated\.$' "$build/tidy/log" || true
  [ "$status" = 0 ] || die 'clang-tidy has complaints'
  say "clang-tidy: all right, $(wc -l <"$build/tidy/files") files"
}

verb_lint() {
  need_packages build lint
  (cd "$here" && sources | xargs clang-format --dry-run -Werror) || die 'some files are not formatted: coop format'
  say 'format: all right'
  case ${1:-} in
    --tidy) tidy all ;;
    --tidy-changed) tidy changed ;;
    '') ;;
    *) die "lint: no option '$1'" ;;
  esac
}

verb_package() {
  need_packages build package
  prepare programs
  (cd "$build" && cpack -G DEB >cpack.log 2>&1) || { tail -n 20 "$build/cpack.log" >&2; die 'packaging failed'; }
  ls "$build"/*.deb
}
