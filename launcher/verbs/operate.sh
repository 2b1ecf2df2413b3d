# Verbs for a system that is deployed: its health, and its composition in containers.

help_25_operate() {
  cat <<'TEXT'
Operate
  health [NAME]         what a component says of itself: ready, degraded (exit code 0), starting,
                        stopping (3), stale: stopped or stuck (4), absent (5); takes milliseconds
  compose FILE [--override host|security|hardware] [--set ...]
                        the launch file as a Compose file for containers, on stdout; an override is
                        named after it: docker-compose -f compose.yaml -f host.yaml up -d
TEXT
}

verb_health() {
  need_programs
  exec "$programs/health" "$@"
}

verb_compose() { prepare_programs; verb_launcher compose "$@"; }
