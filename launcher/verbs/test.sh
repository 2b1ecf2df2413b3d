# `coop test` and `coop bench`.

# Sums over the results GoogleTest has written, and over programs that died without writing any.
summarise() { # folder
  local folder=$1
  cat "$folder"/*.xml 2>/dev/null | awk '
    function attribute(name,  text) {
      if (!match($0, name "=\"[^\"]*\"")) return ""
      text = substr($0, RSTART, RLENGTH)
      gsub(/^[^"]*"|"$/, "", text)
      return text
    }
    /<testcase / { test = attribute("classname") "." attribute("name") }
    /<skipped / { reason = attribute("message"); sub(/&#x0A;.*/, "", reason)
                  gsub(/&quot;/, "\"", reason); gsub(/&lt;/, "<", reason); gsub(/&gt;/, ">", reason)
                  gsub(/&apos;/, "\x27", reason); gsub(/&amp;/, "\\&", reason)
                  sub(/^not run: /, "", reason); print "not run: " test ": " reason }
    /<testsuite / { all += attribute("tests"); failed += attribute("failures") + attribute("errors")
                    skipped += attribute("skipped") + attribute("disabled") }
    END { print "sum " all - failed - skipped, failed, skipped }' >"$folder/summary"
  grep '^not run:' "$folder/summary" || true
  local passed failed skipped name
  read -r passed failed skipped < <(sed -n 's/^sum //p' "$folder/summary")
  while IFS=: read -r _ name; do
    [ -n "$name" ] || continue
    if ! grep -q '<failure' "$folder/$name.xml" 2>/dev/null; then
      echo "died or took too long: $name"
      failed=$((failed + 1))
    fi
  done <"$folder/failed"
  echo "$passed passed, $failed failed, $skipped skipped"
  [ "$failed" -eq 0 ] && [ $((passed + skipped)) -gt 0 ]
}

# Options the sanitizers need with Fast DDS; what the caller has set stands.
sanitizer_settings() {
  as_is=(env)
  case $preset in
    asan)
      # new_delete_type_mismatch: a destructor of Fast DDS 2.9.1.
      export ASAN_OPTIONS=${ASAN_OPTIONS:-new_delete_type_mismatch=0}
      export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$here/tests/lsan.supp:print_suppressions=0}
      ;;
    tsan)
      export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$here/tests/tsan.supp}
      # ThreadSanitizer of gcc 12 does not start under the address randomisation of newer kernels.
      if setarch -R true 2>/dev/null; then as_is=(setarch -R); fi
      ;;
  esac
}

verb_test() {
  local label=all filter= arguments=()
  case ${1:-all} in
    unit | component | system | all) label=${1:-all}; [ $# -eq 0 ] || shift ;;
    -h | --help) help_90_develop | sed -n '/^  test/,/^  bench/p' | sed '$d'; return ;;
  esac
  filter=${1:-}
  [ "$label" = all ] || arguments+=(-L "^$label\$")
  [ -z "$filter" ] || arguments+=(-R "$filter")
  case $label in
    unit | component) prepare "tests_$label" ;;
    system) prepare programs tests_system ;;
    *) prepare "${programs_and_tests[@]}" ;;
  esac
  sanitizer_settings
  local results=$build/test-results
  rm -rf "$results" "$build/Testing/Temporary/LastTestsFailed.log"
  mkdir -p "$results"
  GTEST_OUTPUT="xml:$results/" "${as_is[@]}" ctest --test-dir "$build" -j "$jobs" --output-on-failure \
    --no-tests=error "${arguments[@]}" || true
  cp "$build/Testing/Temporary/LastTestsFailed.log" "$results/failed" 2>/dev/null || : >"$results/failed"
  summarise "$results"
}

verb_bench() {
  prepare all
  run_benches "${1:-}"
}

run_benches() { # regular expression over what is built
  local program name found= results=$build/bench/results
  mkdir -p "$results"
  for program in "$build"/bench/*; do
    name=$(basename "$program")
    [ -f "$program" ] && [ -x "$program" ] && [[ $name =~ ${1:-} ]] || continue
    found=yes
    "$program" --benchmark_out="$results/$name.json" --benchmark_out_format=json
  done
  [ -n "$found" ] || die "no benchmark matches '${1:-}'"
  say "results as JSON: $results"
}
