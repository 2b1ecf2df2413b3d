# Verbs of `coop` for running a system: the launcher's own, and what looks into a run.

help_20_run() {
  cat <<'TEXT'
Run a system
  up FILE [--set component.key=value] [--seed N] [--until ready|mission-done] [--timeout S]
                        start the components of a launch file (sim, survey, config/launch/sim.yaml)
                        and stay with them until Ctrl-C; more with: coop up --help
  ps                    table of the components: state, pid, restarts, processor, memory
  restart NAME          restart one component, leaving the others alone
  stop NAME             stop one component
  start NAME            start it again
  logs NAME [-f]        what a component has printed; NAME launcher: what happened to the system
  down                  stop the whole system
  trace RUN [OTHER]     hash over every sample of a lockstep run, or the first difference of two
  check FILE            check a launch file and every configuration it names, start nothing
TEXT
}

verb_launcher() { # verb arguments...
  need_programs
  exec "$programs/launcher" "$@"
}

verb_up() { prepare_programs; verb_launcher up "$@"; }
verb_check() { prepare_programs; verb_launcher check "$@"; }
verb_ps() { verb_launcher ps "$@"; }
verb_restart() { verb_launcher restart "$@"; }
verb_stop() { verb_launcher stop "$@"; }
verb_start() { verb_launcher start "$@"; }
verb_down() { verb_launcher down "$@"; }
verb_logs() { verb_launcher logs "$@"; }

verb_trace() {
  prepare_programs
  exec "$programs/trace" "$@"
}
