# Verbs of `coop` for captures: recorded messages and what is done with them.

help_30_capture() {
  cat <<'TEXT'
Captures (MCAP files)
  info FILE             times, messages and rates of each topic, schemas, attachments of a capture
  mcap recover FILE [-o OUT]
                        a complete file of one whose writer was killed, or that was damaged
  mcap filter FILE -o OUT [--topics T...] [--exclude T...] [--start S] [--end S]
                        a part of it, by topic and time
  mcap merge FILE... -o OUT
                        several as one, in the order of time
  mcap cat FILE         one line a message, without decoding it
  mcap cat FILE --yaml|--json [-o OUT] [--topics T,...] [--max-array N]
                        with all values: a YAML document or a line of JSON a message
  mcap attachments FILE [NAME...] [--extract DIR]
                        launch file, configuration, maps that were recorded with it
TEXT
}

verb_mcap() {
  prepare_programs
  if [ "${1-}" = cat ] && has_option --yaml --json "$@"; then exec "$programs/mcap_values" "$@"; fi
  exec "$programs/mcap" "$@"
}
verb_info() { verb_mcap info "$@"; }
