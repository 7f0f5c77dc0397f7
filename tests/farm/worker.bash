# Workers of remapc as steps of Slurm: `--worker "NAME=srun ..."` gives the table of a local worker, and a step, a node or remapc
# itself that dies costs no more than the pictures that were being rendered.
#
#   worker.bash REMAPC SOURCES
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/slurm.bash"
need_slurm
enter_farm "$0" "$@"
readonly remapc=$1 worker="python3 $2/examples/lambert_worker.py"
readonly by_srun="example=srun -N1 -n1 $worker"
readonly sweep=(sweep --source example/blinn-phong --target mitsuba/ggx --roughness-range 0.1,0.6 --roughness-samples 12
  --specular-range 0,0.1 --specular-samples 3 --resolution 128)
cd "$farm"

kept_pictures() { find cache -type f 2>/dev/null | wc -l; }

has_begun() { [[ $(kept_pictures) -ge 10 ]]; }

no_steps() { no_jobs && [[ -z $(squeue --noheader --steps) ]]; }

is_the_table() { cmp local.csv "$1"; }

# A sweep that keeps its pictures.
readonly cached=("$remapc" "${sweep[@]}" --worker "$by_srun" --cache cache --force -o table.csv)

# interrupted TITLE COMMAND...: the command meets a sweep that has begun; another sweep finishes what is left.
interrupted() {
  local -r title=$1
  local code=0 kept
  shift
  rm -rf cache table.csv*
  "${cached[@]}" >interrupted.txt 2>&1 &
  sweep_pid=$!
  wait_until 20 has_begun || echo "no pictures" >&2
  "$@"
  wait "$sweep_pid" 2>/dev/null || code=$?
  kept=$(kept_pictures)
  echo "$title: exit code $code, $kept pictures kept: $(tail -n 1 interrupted.txt | cut -c 1-200)"
  check "$title: pictures are kept" test "$kept" -ge 10
  check "$title: no step runs on" wait_until 30 no_steps
  [[ $code == 0 || $code == 137 ]] || check "$title: it is told" grep -q "worker example, request" interrupted.txt
  check "$title: another sweep ends well" "${cached[@]}"
  check "$title: its table" is_the_table table.csv
}

kill_step() { scancel --signal=KILL "$(squeue --noheader --steps --format=%i | head -n 1)"; }

kill_remapc() { kill -9 "$sweep_pid"; }

lose_a_node() {
  local node
  node=$(squeue --noheader --states=RUNNING --format=%N | head -n 1)
  lose_node "$node"
  give_up_node "$node"
}

check "a local worker" "$remapc" "${sweep[@]}" --worker "example=$worker" --no-cache -o local.csv
start_slurm
check "steps of srun" "$remapc" "${sweep[@]}" --worker "$by_srun" --no-cache -o srun.csv
check "steps of srun: the same table" is_the_table srun.csv
cat >allocation.sbatch <<SBATCH
#!/bin/bash
#SBATCH --nodes=2 --ntasks=4 --output=allocation.txt
$(printf '%q ' "$remapc" "${sweep[@]}" --worker "example=srun --exact -N1 -n1 $worker" --worker-processes 4 --no-cache \
  -o allocation.csv)
SBATCH
check "steps in an allocation" sbatch --wait allocation.sbatch
check "steps in an allocation: the same table" is_the_table allocation.csv
interrupted "a step is killed" kill_step
interrupted "a node is lost" lose_a_node
interrupted "remapc is killed" kill_remapc
# Pictures are handed over in /dev/shm, which another machine does not share.
"$remapc" "${sweep[@]}" --no-cache -o other.csv \
  --worker "example=srun -N1 -n1 unshare --mount sh -c 'mount -t tmpfs none /dev/shm; exec $worker'" >other.txt 2>&1
echo "a worker that sees another /dev/shm: exit code $?: $(tail -n 1 other.txt | cut -c 1-250)"
end_farm
