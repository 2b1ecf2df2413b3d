# Verbs of `coop` for recording, playing and looking at what the components say to each other.

help_31_traffic() {
  cat <<'TEXT'
Record and replay (docs/capture.md)
  record [-o DIR] [--topics P...] [--exclude P...] [--last 10min] [--domain N] [--robot NAME]
                        every topic into an MCAP file, until Ctrl-C; --last: into memory, written when
                        something goes wrong or by:
  snapshot [REASON]     what the recorder of a running system holds goes to disk
  play FILE [--rate R] [--loop] [--start T] [--duration T] [--topics P...] [--without COMPONENT...]
                        a capture onto the topics it came from, with /clock; space, n and q are keys
  topic list | echo T | hz T | bw T | delay T
                        what is on the topics of a running system; --json
  tf tree | echo PARENT CHILD
                        its frames, who publishes them and what is wrong with them; --json
  sniff [FILE.pcap] [--domain N] [--seconds S]
                        what is on the wire: the packets of a domain, by topic (tshark)
TEXT
}

capture_program() { # program arguments...
  local program=$1
  shift
  prepare_programs
  exec "$programs/$program" "$@"
}

verb_record() { capture_program record "$@"; }
verb_topic() { capture_program topic "$@"; }
verb_tf() { capture_program tf "$@"; }
verb_snapshot() { capture_program topic snapshot "$@"; }

# The terminal is put back even where the player is killed.
verb_play() {
  prepare_programs
  local saved status=0
  saved=$(stty -g 2>/dev/null) || saved=
  "$programs/play" "$@" || status=$?
  [ -z "$saved" ] || stty "$saved" 2>/dev/null || true
  return "$status"
}

# UDP ports of a DDS domain: discovery, then two a participant.
ports_of_domain() { echo "$((7400 + 250 * $1))-$((7400 + 250 * $1 + 249))"; }

# What tshark says of each packet, or, with --topics, every topic, type and participant that discovery told of meanwhile.
verb_sniff() {
  local file= domain=0 seconds= interface=any write= topics=
  while [ $# -gt 0 ]; do
    case $1 in
      --domain | --seconds | --interface | -w | --write)
        [ $# -gt 1 ] || die "sniff: $1 needs a value"
        case $1 in
          --domain) domain=$2 ;;
          --seconds) seconds=$2 ;;
          --interface) interface=$2 ;;
          *) write=$2 ;;
        esac
        shift 2 ;;
      --topics) topics=yes; shift ;;
      -h | --help) sniff_help; return ;;
      -*) die "sniff: no option '$1' (see coop sniff --help)" ;;
      *) [ -z "$file" ] || die "sniff: one capture, please, not also '$1'"; file=$1; shift ;;
    esac
  done
  [[ $domain =~ ^[0-9]+$ ]] && [ "$domain" -le 232 ] || die "sniff: expected a domain from 0 to 232, found '$domain'"
  command -v tshark >/dev/null || die 'sniff: tshark is not installed: apt-get install tshark'
  local source=()
  if [ -n "$file" ]; then
    [ -r "$file" ] || die "sniff: no capture '$file'"
    source=(-r "$file")
  else
    source=(-i "$interface" -f "udp portrange $(ports_of_domain "$domain")")
    [ -z "$seconds" ] || source+=(-a "duration:$seconds")
  fi
  if [ -n "$write" ]; then
    exec tshark -q "${source[@]}" -w "$write"
  elif [ -n "$topics" ]; then
    local asker=
    if [ -z "$file" ]; then
      ask_for_topics "$domain" &
      asker=$!
    fi
    tshark -Q "${source[@]}" -Y 'rtps.param.topicName' -T fields -e rtps.param.topicName -e rtps.param.typeName |
      awk -F '\t' '{ n = split($1, topics, ","); split($2, types, ","); for (i = 1; i <= n; ++i) print topics[i], types[i] }' |
      sort | uniq -c | awk 'BEGIN { printf "%8s  %-40s %s\n", "TIMES", "TOPIC", "TYPE" } { printf "%8s  %-40s %s\n", $1, $2, $3 }'
    [ -z "$asker" ] || kill "$asker" 2>/dev/null || true
  else
    exec tshark -l "${source[@]}" -Y rtps
  fi
}

# Programs that run tell a newcomer all they write and read: one newcomer after the other, until killed.
ask_for_topics() { # domain
  while "$programs/topic" list --domain "$1" --wait 1 >/dev/null 2>&1; do :; done
}

sniff_help() {
  cat <<'TEXT'
Usage: coop sniff [FILE.pcap] [--domain N] [--topics] [--seconds S] [--interface I] [-w FILE.pcap]
The packets of a DDS domain (UDP ports 7400 + 250 N and the 249 that follow), as tshark dissects RTPS.

  FILE.pcap       a capture made before, instead of the wire
  --topics        only the topics and types that discovery tells of meanwhile; of a live domain all of them are
                  asked for, by a program that joins it
  --seconds S     end after that time
  --interface I   default: any, the machine's own traffic included
  -w FILE.pcap    write the packets; open them in Wireshark with the display filter rtps

Capturing needs root or the capability to (dpkg-reconfigure wireshark-common). Traffic over shared memory is on no wire.
TEXT
}
