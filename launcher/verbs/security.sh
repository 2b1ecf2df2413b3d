# Keys of DDS Security.

help_60_security() {
  cat <<'TEXT'
Security (docs/security.md)
  keys make FILE [--folder keys] [--protection discovery|data|all] [--days N]
                        for each component of a launch file an identity and its topics
  keys rotate FILE [NAME...] [--folder keys]    new keys from the same authority
  keys revoke FOLDER NAME    keys that are lost are refused; list FOLDER: whose there are
TEXT
}

verb_keys() {
  prepare_programs
  need_programs
  exec "$programs/keys" "$@"
}
