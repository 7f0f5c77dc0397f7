# Tests workers of remapc as steps of Slurm. `--worker "NAME=srun ..."` must give the same table as a local worker. If
# a step is cancelled or hangs, or a node is lost, the sweep must only take longer. If remapc itself dies, only the
# pictures that were being rendered are lost.
#
#   worker.bash REMAPC SOURCES
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/slurm.bash"
need_slurm
enter_farm "$0" "$@"
readonly remapc=$1 worker="python3 $2/examples/lambert_worker.py"
readonly by_srun="example=srun -N1 -n1 $worker"
readonly least_kept=6
# A sweep that is disturbed must run long enough. All other sweeps are short.
readonly pair=(sweep --source example/blinn-phong --target mitsuba/ggx --roughness-range 0.1,0.6 --specular-range 0,0.1
  --specular-samples 3)
readonly sweep=("${pair[@]}" --roughness-samples 8 --resolution 96) short=("${pair[@]}" --roughness-samples 3 --resolution 48)
cd "$farm"
mkdir pictures

kept_pictures() { find cache -type f 2>/dev/null | wc -l; }

has_begun() { [[ $(kept_pictures) -ge $least_kept ]]; }

no_steps() { no_jobs && [[ -z $(squeue --noheader --steps) ]]; }

is_the_table() { cmp local.csv "$1"; }

is_the_short_table() { cmp short.csv "$1"; }

# This sweep stores its pictures in the cache.
readonly cached=("$remapc" "${sweep[@]}" --worker "$by_srun" --worker-folder pictures --cache cache --force -o table.csv)
patience=8

# met TITLE COMMAND... starts a sweep, and runs the command when the sweep has begun. $code is then the exit code of
# the sweep.
met() {
  local -r title=$1
  code=0
  shift
  rm -rf cache table.csv*
  "${cached[@]}" --worker-timeout "$patience" >met.txt 2>&1 &
  sweep_pid=$!
  wait_until 20 has_begun || echo "no pictures" >&2
  "$@"
  wait "$sweep_pid" 2>/dev/null || code=$?
  echo "$title: exit code $code, $(kept_pictures) pictures kept: $(tail -n 1 met.txt | cut -c 1-200)"
  check "$title: no step runs on" wait_until 30 no_steps
}

is_said() {
  grep -q "warning: worker example, request .* (another process renders the picture)" met.txt && grep -q " lost, " met.txt
}

# survived TITLE COMMAND... checks that the sweep continues, reports its losses, and leaves no files.
survived() {
  met "$@"
  check "$1: the sweep goes on" test "$code" == 0
  check "$1: it is said" is_said
  check "$1: its table" is_the_table table.csv
  check "$1: the folder of pictures is empty" test -z "$(ls -A pictures)"
}

# ended TITLE COMMAND... checks that another sweep finishes the rest and removes leftover files.
ended() {
  met "$@"
  check "$1: pictures are kept" has_begun
  check "$1: another sweep ends well" "${cached[@]}"
  check "$1: its table" is_the_table table.csv
  check "$1: the folder of pictures is empty" test -z "$(ls -A pictures)"
}

a_step() { squeue --noheader --steps --format=%i | head -n 1; }

kill_step() { scancel --signal=KILL "$(a_step)"; }

stop_step() { scancel --signal=STOP "$(a_step)"; }

# Cancels the whole job of srun.
cancel_job() { scancel "$(squeue --noheader --states=RUNNING --format=%i | head -n 1)"; }

kill_remapc() { kill -9 "$sweep_pid"; }

interrupt_remapc() { kill -TERM "$sweep_pid"; }

lose_a_node() {
  local node
  node=$(squeue --noheader --states=RUNNING --format=%N | head -n 1)
  lose_node "$node"
  give_up_node "$node"
}

check "a local worker" "$remapc" "${sweep[@]}" --worker "example=$worker" --no-cache -o local.csv
check "a local worker, a short sweep" "$remapc" "${short[@]}" --worker "example=$worker" --no-cache -o short.csv
start_slurm
check "steps of srun" "$remapc" "${short[@]}" --worker "$by_srun" --no-cache -o srun.csv
check "steps of srun: the same table" is_the_short_table srun.csv
cat >allocation.sbatch <<SBATCH
#!/bin/bash
#SBATCH --nodes=2 --ntasks=4 --output=allocation.txt
$(printf '%q ' "$remapc" "${short[@]}" --worker "example=srun --exact -N1 -n1 $worker" --worker-processes 4 --no-cache \
  -o allocation.csv)
SBATCH
# `sbatch --wait` would only look every few seconds.
ends_well() {
  local job
  job=$(sbatch --parsable "$1") && wait_until 60 no_jobs && scontrol show job "$job" | grep "JobState=COMPLETED"
}
check "steps in an allocation" ends_well allocation.sbatch
check "steps in an allocation: the same table" is_the_short_table allocation.csv
survived "a step is killed" kill_step
survived "a job is cancelled" cancel_job
patience=3
survived "a step hangs" stop_step
patience=8
survived "a node is lost" lose_a_node
ended "remapc is killed" kill_remapc
ended "remapc is interrupted" interrupt_remapc

# /dev/shm is not shared with another machine, which this worker simulates.
readonly elsewhere="example=srun -N1 -n1 unshare --mount sh -c 'mount -t tmpfs none /dev/shm; exec $worker'"
is_refused() {
  ! "$remapc" "${short[@]}" --no-cache -o other.csv --worker "$elsewhere" 2>other.txt &&
    grep "No such file or directory.*--worker-folder FOLDER" other.txt
}
check "a worker elsewhere needs a folder" is_refused
check "a worker elsewhere" "$remapc" "${short[@]}" --no-cache -o other.csv --worker "$elsewhere" --worker-folder pictures
check "a worker elsewhere: the same table" is_the_short_table other.csv

# Each process of a sweep needs a licence.
most_steps() {
  local count most=0
  "$@" >capped.txt 2>&1 &
  while kill -0 $! 2>/dev/null; do
    count=$(squeue --noheader --steps --format=%i | wc -l)
    ((count <= most)) || most=$count
  done
  wait $! && echo "at most $most steps at once" && ((most == 1))
}
check "one process at once" most_steps "$remapc" "${short[@]}" --worker "$by_srun" --worker-processes 1 --jobs 4 --no-cache -o one.csv
check "one process at once: the same table" is_the_short_table one.csv
end_farm
