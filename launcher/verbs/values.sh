# Verbs of `coop` for what captures hold: values, tables, differences; and logs of others as captures.

help_31_values() {
  cat <<'TEXT'
Values in captures
  csv FILE TOPIC [-o OUT] [--max-array N]
                        a topic as a table: a row a message, a column a value
  diff A B [--topics T,...] [--ignore-times]
                        the first difference of each topic, by message and field; counts and times too
  import LOG -o OUT     a CARMEN log as a capture of scan, odom, tf (--laser X Y YAW: where it is mounted),
                        or a rosbag2 recording (sqlite3: its folder or .db3 file)
TEXT
}

verb_csv() {
  prepare_programs
  exec "$programs/mcap_values" csv "$@"
}

verb_diff() {
  prepare_programs
  exec "$programs/mcap_values" diff "$@"
}

verb_import() {
  prepare_programs
  if [ -d "${1-}" ] || [[ ${1-} == *.db3 ]]; then exec "$programs/mcap" import "$@"; fi
  exec "$programs/import_carmen" "$@"
}
