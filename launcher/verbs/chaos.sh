# `coop chaos`: missions with faults.

help_31_chaos() {
  cat <<'TEXT'
Break a system
  chaos [--faults 200] [--seed 1] [--rate 2] [--gap 18] [--components NAME...] [-o DIR]
                        missions of the simulated robot while programs die, hang, are slow, lose packets
                        or find the disk full, judged by the truth of the world; as root more kinds
  experiment restart [--rounds 20]
                        how long each component is away when it is killed
TEXT
}

verb_chaos() { run_experiment_program chaos "$@"; }
