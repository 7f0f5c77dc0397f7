# Tests one conversion by many processes, under schedulers that lose some of them: Slurm, OpenJD and GNU parallel.
# Even if tasks are killed often, the tree of results must equal the tree of a single process, and the reports must
# have each set once.
#
#   farm.bash TEXREMAP [short | long]
#
# short: 120 sets in 6 parts, below half a minute on two cores.
# long (the default with REMAP_CAMPAIGN=full): 2,000 sets in 40 parts, and over 20 kills in five minutes.
set -uo pipefail
readonly texremap=$1 form=${2:-$([[ ${REMAP_CAMPAIGN-} == full ]] && echo long || echo short)}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/slurm.bash"

readonly convert=(--from mitsuba/ward --to mitsuba/ggx)
sets=2000 parts=40 least_kills=20
# These events happen to the tasks of each scheduler, in this order, at random moments. task: kill -9. batch, job:
# scancel --signal=KILL. daemon: the slurmd of a node dies and comes back, but its tasks continue. node: the machine
# dies with its tasks. lost: like node, but only slurmctld itself notices it. frozen: the machine stops until other
# machines have done its tasks.
declare -A troubles=([slurm]="task batch frozen node job task daemon task lost batch task node task job"
  [openjd]="task task task task task task" [commands]="task task task task task task task task")
if [[ $form == short ]]; then
  sets=120 parts=6 least_kills=1
  troubles=([slurm]="task batch node" [openjd]="task task" [commands]="task task task")
fi

find_openjd() {
  local program
  for program in "$(command -v openjd)" "$here/../../build/farm/bin/openjd"; do
    [[ ! -x $program ]] || { echo "$program" && return; }
  done
  return 1
}

# conversions WAY prints the process ids of texremap that convert for this scheduler, without the process that merges.
conversions() {
  local pid
  for pid in $(pgrep -x texremap); do
    ! grep -qsz '^convert$' "/proc/$pid/cmdline" || ! grep -qsz "out_$1\$" "/proc/$pid/cmdline" || echo "$pid"
  done
}

# running FORMAT prints the running jobs of the plan. All other jobs have other names.
running() { squeue --noheader --states=RUNNING --name=texremap --format="$1"; }

# trouble WAY KIND causes an event of this kind. It fails if no process runs that the event could hit.
trouble() {
  local victim
  case $2 in
    task)
      victim=$(conversions "$1" | shuf -n 1) && [[ -n $victim ]] || return
      kill -9 "$victim"
      ;;
    batch | job)
      victim=$(running %i | shuf -n 1) && [[ -n $victim ]] || return
      if [[ $2 == batch ]]; then scancel --signal=KILL --batch "$victim"; else scancel --signal=KILL "$victim"; fi
      ;;
    daemon | node | lost | frozen)
      victim=$(running %N | shuf -n 1) && [[ -n $victim ]] || return
      case $2 in
        daemon) kill_daemon "$victim" && start_node "$victim" ;;
        node) lose_node "$victim" && give_up_node "$victim" ;;
        lost) lose_node "$victim" && start_node "$victim" ;;
        frozen) freeze_node "$victim" 10 ;;
      esac
      ;;
  esac 2>>"$farm/troubles.txt" || return
  echo "$1 $2" >>"$farm/happened.txt"
}

report_of() { printf '%s/.texremap-parts/part-%04d-of-%04d.jsonl' "$1" "$2" "$3"; }

# missing_parts OUT prints the numbers of parts without a report, one per line.
missing_parts() {
  local i
  for ((i = 1; i <= parts; ++i)); do
    [[ -e $(report_of "$1" "$i" "$parts") ]] || echo "$i"
  done
}

# run_WAY PLAN [PART...] runs all parts, or the given parts, and the merge.
run_slurm() {
  local numbers="${*:2}"
  sh "$1/submit.sh" ${numbers:+"${numbers// /,}"} && wait_until 300 no_jobs
}

# One `openjd run` is one worker. The first round is a whole job, which ends at its first failed task.
run_openjd() {
  local -a run=("$openjd" run "$1/template.json")
  [[ ! -e $1/parameters.json ]] || run+=(--job-param "file://$1/parameters.json")
  if [[ $# == 1 ]]; then
    "${run[@]}"
  else
    printf '%s\n' "${@:2}" | xargs -P 2 -I{} "${run[@]}" --step Convert --task-param Part={}
    "${run[@]}" --step Merge --no-run-dependencies
  fi
}

run_commands() {
  local -a lines=("${@:2}")
  if [[ $# == 1 ]]; then cat "$1/commands.txt"; else sed -n "${lines[*]/%/p;}" "$1/commands.txt"; fi |
    parallel --will-cite --jobs 2
  sh "$1/merge.sh"
}

# Converts in rounds and disturbs them. Each round runs the parts that have no report. The variable `rounds` gets the
# number of rounds.
run_in_rounds() {
  local -r way=$1 plan=$2 out=$3
  local -a waiting=(${troubles[$way]}) todo=()
  local runner
  rounds=0
  while :; do
    "run_$way" "$plan" "${todo[@]}" >>"$farm/$way.txt" 2>&1 &
    runner=$!
    while [[ ${#waiting[@]} -gt 0 ]] && kill -0 "$runner" 2>/dev/null; do
      sleep "0.$((RANDOM % 4))$((RANDOM % 10))"
      ! trouble "$way" "${waiting[0]}" || waiting=("${waiting[@]:1}")
    done
    wait "$runner"
    ((rounds += 1))
    readarray -t todo < <(missing_parts "$out")
    [[ ${#todo[@]} -gt 0 ]] || return 0
    ((rounds < 12)) || { echo "parts ${todo[*]} never finish:" && tail -n 8 "$farm/$way.txt" && return 1; }
  done
}

# equal_trees ONE OTHER compares two trees, except for reports and journals.
equal_trees() { diff -r --brief --exclude='.texremap*' "$1" "$2"; }

# nothing_unfinished OUT checks that OUT has no hidden files except the records of the conversion.
nothing_unfinished() { ! find "$1" -name '.*' -not -path "$1/.texremap*" -not -path "$1" | grep .; }

# each_set_once OUT checks that the reports of the parts have every set of the manifest once.
each_set_once() {
  /usr/bin/python3 - "$1" "$farm/sets.jsonl" <<'PYTHON'
import collections, json, pathlib, sys
out, manifest = map(pathlib.Path, sys.argv[1:])
lines = [json.loads(line) for line in manifest.open()]
expected = {f"{lines[0]['root']}/{line['id']}" for line in lines[1:]}
found = collections.Counter()
for report in out.glob(".texremap-parts/*.jsonl"):
    found.update(line["set"]["name"] for line in map(json.loads, report.open()) if "set" in line)
wrong = sorted(expected ^ found.keys()) + [name for name, count in found.items() if count != 1]
sys.exit(f"{len(wrong)} sets missing, unknown or twice: {wrong[:3]}" if wrong else 0)
PYTHON
}

judge() {
  local -r title=$1 out=$2
  check "$title: the report is whole" "$texremap" merge-reports "$out"
  check "$title: every set is in one part" each_set_once "$out"
  check "$title: the files of one process" equal_trees one "$out"
  check "$title: nothing unfinished is left" nothing_unfinished "$out"
}

try_way() {
  local -r way=$1 start=$EPOCHREALTIME
  check "$way: plan" "$texremap" plan "$way" --manifest sets.jsonl --parts "$parts" -o "plan_$way" -- \
    "${convert[@]}" -o "out_$way"
  [[ $way != openjd ]] || check "openjd: its own check" "$openjd" check plan_openjd/template.json
  check "$way: all parts finish" run_in_rounds "$way" "$PWD/plan_$way" "$PWD/out_$way"
  wait
  judge "$way" "out_$way"
  check "$way: the plan's own merge" test -s "plan_$way/report.jsonl"
  echo "$way: $rounds rounds, $(seconds_since "$start") s"
}

# The disk is full until an administrator makes room. Tasks then end with 75, and their scripts queue them again
# seconds later.
fill_disk() {
  mkdir full
  mount -t tmpfs -o "size=$(($(du -sk one | cut -f1) / 2))k" tmpfs full
  local -r half=$(df --output=size full | tail -n 1)
  check "full disk: plan" "$texremap" plan slurm --manifest sets.jsonl --parts 2 -o plan_full -- "${convert[@]}" -o full/out
  SBATCH_JOB_NAME=full sh plan_full/submit.sh >full.txt
  check "full disk: tasks are queued again" wait_until 60 grep -rqs "DUE TO JOB REQUEUE" plan_full/log
  mount -o "remount,size=$((10 * half))k" full
}

judge_full_disk() {
  check "full disk: they end" wait_until 120 no_jobs
  judge "full disk, with more room" full/out
}

# These names have a meaning for a scheduler or a shell.
readonly odd="odd %a {{n}} 'o' \$x"
try_odd_names() {
  local way
  for way in "$@"; do
    check "odd names: plan $way" "$texremap" plan "$way" --manifest "$odd/sets.jsonl" --parts 2 -o "$odd/plan_$way" -- \
      "${convert[@]}" -o "$odd/$way"
    check "odd names: $way" "run_$way" "$PWD/$odd/plan_$way"
    check "odd names: $way: the report is whole" "$texremap" merge-reports "$odd/$way"
    check "odd names: $way: the plan's own merge" test -s "$odd/plan_$way/report.jsonl"
  done
}

two_at_once() {
  local i first second
  for i in 1 2; do
    "$texremap" convert --manifest sets.jsonl --part "$i/2" "${convert[@]}" -o twice &
    first=$!
    "$texremap" convert --manifest sets.jsonl --part "$i/2" "${convert[@]}" -o twice &
    second=$!
    wait "$first" || return
    wait "$second" || return
  done
}

try_two_at_once() {
  check "two copies of a part at once: both end well" two_at_once
  judge "two copies of a part at once" twice
}

milliseconds_since() { awk "BEGIN { printf \"%.0f\", 1000 * ($EPOCHREALTIME - $1) / $2 }"; }

print_figures() {
  local n start=$EPOCHREALTIME
  local -ra empty=("$texremap" convert --manifest sets.jsonl --part 2/1000000 "${convert[@]}" --quiet -o empty)
  for n in 1 2 3 4 5 6 7 8 9 10; do "${empty[@]}"; done
  echo "a part without sets, from start to end: $(milliseconds_since "$start" 10) ms"
  if [[ $form == long ]]; then
    start=$EPOCHREALTIME
    sbatch --wait --array=1-100 --output=/dev/null --wrap="$(printf '%q ' "${empty[@]}")" >/dev/null
    echo "an array of 100 of these under Slurm, four at once: $(milliseconds_since "$start" 100) ms a part"
  fi
  echo "troubles:"
  sort "$farm/happened.txt" | uniq -c
}

# The checks of a lane run one after another. One lane uses Slurm, the other does not.
lane_of_slurm() {
  fill_disk
  try_way slurm
  judge_full_disk
  try_odd_names slurm
  check "odd names: a log of each part" test -e "$odd/plan_slurm/log/2.txt"
}

lane_of_others() {
  try_way openjd
  try_way commands
  try_odd_names openjd commands
  try_two_at_once
}

main() {
  need_slurm
  openjd=$(find_openjd) || skip_farm openjd "no openjd (tests/farm/install)"
  [[ $(parallel --version 2>/dev/null) == GNU* ]] || skip_farm parallel "no GNU parallel (tests/farm/install)"
  /usr/bin/python3 -c 'import numpy' 2>/dev/null || skip_farm numpy "no NumPy (Debian: python3-numpy)"
  enter_farm "$0" "$@"
  cd "$farm"
  export TMPDIR=$farm PARALLEL_HOME=$farm/parallel

  /usr/bin/python3 "$here/make_sets.py" in "$sets"
  check "index" "$texremap" index in -o sets.jsonl
  check "one process" "$texremap" convert --manifest sets.jsonl "${convert[@]}" -o one
  mkdir "$odd"
  "$texremap" index in/region0 --quiet -o "$odd/sets.jsonl"
  start_slurm
  begin_lane slurm lane_of_slurm
  begin_lane others lane_of_others
  end_lane slurm
  end_lane others
  print_figures
  kills=$(wc -l <"$farm/happened.txt")
  check "at least $least_kills kills: $kills" test "$kills" -ge "$least_kills"
  end_farm
}

main "$@"
