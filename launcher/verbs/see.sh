# Verbs of `coop` for seeing what it does: missions, mapping, experiments, sweeps.

help_10_see() {
  cat <<'TEXT'
See it
  demo [--seed N] [-o DIR] [--domain D]
                        a simulated robot maps a duck house, then finds five eggs and collects them;
                        leaves map, picture and report in DIR (default: a new folder in runs/)
  demo pig_pen [--pen K | --all-pens] [--seed N] [-o DIR] [--domain D]
                        a simulated robot cleans one of eight pens of manure, among its pigs, told by
                        a camera above; leaves pictures and report
  map LOG.clf -o DIR    map a recorded building: chassis and lidar play the log, slam maps it;
                        leaves map and trajectory in DIR
  experiment navigation [--tests 30] [--seed 1] [--jobs 1] [-o DIR]
                        the egg paper's experiment: five eggs a test, table and causes of every failure
  sweep FILE [-o DIR] [--jobs J] [--seeds N] [--set component.key=value]
                        a launch file over parameters and seeds (weights, prediction_time, or a file);
                        both go on where they were when called again with the same DIR, unless what
                        they are made of has changed (--restart: all anew);
                        --engine slurm [--partition P] [--slurm-options=...]: on a Slurm cluster
TEXT
}

new_run_folder() { # name
  printf 'runs/%s-%s' "$1" "$(date +%Y%m%d-%H%M%S)"
}

has_option() { # short long arguments...
  local short=$1 long=$2 argument
  shift 2
  for argument in "$@"; do
    case $argument in "$short" | "$long" | "$long"=*) return 0 ;; esac
  done
  return 1
}

verb_demo() {
  prepare_programs
  if has_option -o --output "$@" || has_option -h --help "$@"; then
    exec "$programs/demo" "$@"
  fi
  exec "$programs/demo" -o "$(new_run_folder demo)" "$@"
}

verb_map() {
  local log= out= more=()
  while [ $# -gt 0 ]; do
    case $1 in
      -o | --output) [ $# -gt 1 ] || die 'map: -o needs a folder'; out=$2; shift 2 ;;
      -h | --help) help_10_see | sed -n '/^  map/,/^$/p'; return ;;
      -*) more+=("$1" "${2:-}"); shift; [ $# -eq 0 ] || shift ;;
      *) [ -z "$log" ] || die "map: one log, please, not also '$1'"; log=$1; shift ;;
    esac
  done
  [ -n "$log" ] && [ -n "$out" ] || die 'usage: coop map LOG.clf -o DIR [--seed N] [--set component.key=value]'
  [ -r "$log" ] || die "map: no log '$log'"
  prepare_programs
  mkdir -p "$out"
  exec "$programs/launcher" up "$share/config/launch/map_log.yaml" --run-dir "$out/runs" \
    --set "log=$(readlink -f "$log")" --set "output=$(readlink -f "$out")" "${more[@]}"
}

verb_sweep() {
  prepare_programs
  if has_option -o --output "$@" || has_option -h --help "$@"; then
    exec "$programs/sweep" "$@"
  fi
  exec "$programs/sweep" "$@" -o "$(new_run_folder sweep)"
}

# A program of tests/experiments, which is built in a checkout only and leaves a report in -o.
run_experiment_program() { # name arguments...
  local name=$1
  shift
  in_checkout "experiment $name"
  prepare "${name}_experiment"
  if has_option -o --output "$@" || has_option -h --help "$@"; then
    exec "$build/experiments/${name}_experiment" "$@"
  fi
  exec "$build/experiments/${name}_experiment" "$@" -o "$(new_run_folder "$name")"
}

# Optimal lengths, then speeds: the tables of docs/experiments/planning.md.
experiment_planning() {
  (run_experiment_program "$@")
  has_option -h --help "$@" && return
  prepare core_search_bench core_costmap_bench
  run_benches '^core_(search|costmap)_bench$'
}

verb_experiment() {
  case ${1:-} in
    navigation) verb_sweep "$@" ;;
    casma | restart) run_experiment_program "$@" ;;
    planning) experiment_planning "$@" ;;
    *) die "experiments: navigation, casma, restart, planning; not '${1:-}'" ;;
  esac
}
