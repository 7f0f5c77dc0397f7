# Other scripts source this file. It starts a private Slurm of two nodes on this machine, in separate namespaces. It needs
# slurm-wlm, munge and root. A user is not enough, because slurmctld drops groups, which needs root in a namespace.
#
#   enter_farm "$0" "$@"    runs the script again inside the namespaces. Its ports do not clash, and no process outlives it.
#   check TITLE COMMAND...  prints a line PASS or FAIL. end_farm ends the script with their result.
#   begin_lane NAME COMMAND...; end_lane NAME   runs checks at the same time as other lanes
#   start_slurm             starts munged, slurmctld and two slurmd, whose files are in $farm/slurm
#   lose_node node1         kills its daemon and its tasks, as if the machine failed
#   start_node node1        starts its daemon, as after a reboot
#
# $farm is a folder of the test, which is removed at its end.

readonly farm_nodes=(node1 node2)

# skip_farm WHAT REASON skips the test. WHAT is a word that REMAP_REQUIRE may contain.
skip_farm() {
  echo "skipped: $1: $2"
  [[ ,${REMAP_REQUIRE-}, == *",$1,"* ]] && exit 1
  exit 77
}

need_slurm() {
  local program
  for program in slurmctld slurmd sbatch munged; do
    command -v "$program" >/dev/null || skip_farm slurm "no $program (tests/farm/install)"
  done
}

# This script is the first process of its namespaces. If it ends, the kernel ends all others. It ends together with
# the process that started it, even if that is killed. The next run then removes its folder.
enter_farm() {
  if [[ ${REMAP_FARM-} == inside ]]; then
    trap 'exit 130' INT TERM HUP
    loopback_up
    begun=$EPOCHREALTIME
    return
  fi
  local -ra spaces=(--mount --pid --net --ipc --fork --kill-child --mount-proc)
  unshare "${spaces[@]}" true 2>/dev/null || skip_farm namespaces "only root may make them (unshare ${spaces[*]})"
  local old lock status=0
  for old in "${TMPDIR:-/tmp}"/remap-farm-*/lock; do
    [[ ! -e $old ]] || flock --nonblock "$old" rm -rf "${old%/lock}"
  done
  farm=$(mktemp --directory --tmpdir remap-farm-XXXXXX)
  exec {lock}>"$farm/lock"
  flock "$lock"
  REMAP_FARM=inside farm=$farm setpriv --pdeathsig KILL unshare "${spaces[@]}" bash "$@" &
  local -r inside=$!
  trap 'kill -9 $inside' INT TERM HUP
  wait "$inside" || status=$?
  trap - INT TERM HUP
  rm -rf "$farm"
  if grep -qslzxF "farm=$farm" /proc/[0-9]*/environ; then
    echo "FAIL: a process of $farm is left"
    status=1
  fi
  exit "$status"
}

failed=0
check() {
  local -r title=$1
  shift
  local -r said=$farm/said-$BASHPID.txt
  if "$@" >"$said" 2>&1; then
    echo "PASS: $title"
  else
    echo "FAIL: $title"
    head -n 20 "$said"
    ((failed += 1))
  fi
}

# A lane runs in a subshell, so its variables are lost. Its lines appear together when it has ended.
declare -A lanes
begin_lane() {
  "${@:2}" >"$farm/lane-$1.txt" 2>&1 &
  lanes[$1]=$!
}

end_lane() {
  wait "${lanes[$1]}"
  cat "$farm/lane-$1.txt"
  ((failed += $(grep -c '^FAIL: ' "$farm/lane-$1.txt")))
}

seconds_since() { awk "BEGIN { printf \"%.2f\", $EPOCHREALTIME - $1 }"; }

end_farm() {
  echo "$failed failed; $(seconds_since "$begun") s"
  exit "$((failed > 0))"
}

# ip(8) is not installed everywhere. Slurm does not listen if all addresses are loopback addresses (AI_ADDRCONFIG), so
# lo gets another address.
loopback_up() {
  /usr/bin/python3 - <<'PYTHON'
import fcntl, socket, struct
SIOCSIFFLAGS, SIOCSIFADDR = 0x8914, 0x8916
with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as some:
    fcntl.ioctl(some, SIOCSIFFLAGS, struct.pack("16sH14x", b"lo", 1 | 8 | 64))  # up, loopback, running
    address = struct.pack("HH4s8x", socket.AF_INET, 0, socket.inet_aton("10.77.0.1"))
    fcntl.ioctl(some, SIOCSIFADDR, struct.pack("16s16s8x", b"lo:1", address))
PYTHON
}

# With these times, a lost node is noticed, its tasks are queued again, and both run again within seconds. cred_expire
# is how long a job waits that is queued again. Its least value is 5 s.
write_slurm_conf() {
  local node port=17010
  local -r memory=$(($(sed -n 's/^MemTotal: *\([0-9]*\) kB/\1/p' /proc/meminfo) / 1100))
  cat <<CONF
ClusterName=farm
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=17000
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool-%n
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/%n.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$slurm/finished.txt
JobRequeue=1
ReturnToService=2
SlurmdTimeout=5
MessageTimeout=5
BatchStartTimeout=1
KillWait=1
SchedulerParameters=sched_interval=1,sched_min_interval=100000,batch_sched_delay=0
CONF
  for node in "${farm_nodes[@]}"; do
    echo "NodeName=$node NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$((port += 1)) CPUs=2 RealMemory=$memory"
  done
  echo "PartitionName=farm Nodes=ALL Default=YES MaxTime=INFINITE State=UP"
}

# wait_until SECONDS COMMAND... repeats the command until it succeeds.
wait_until() {
  local -r until=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < until)) || return 1
    sleep 0.1
  done
}

node_is_up() { [[ $(sinfo --noheader --nodes="$1" --format=%t) =~ ^(idle|mix|alloc|comp)$ ]]; }

no_jobs() { [[ -z $(squeue --noheader) ]]; }

slurm_failed() {
  echo "slurm: $1" >&2
  tail -n 20 "$slurm"/*.log >&2
  exit 1
}

# The daemons run in the foreground, so that they are children of this shell. node_pids has their pids.
declare -A node_pids
start_node() {
  slurmd -D -N "$1" >/dev/null 2>&1 &
  node_pids[$1]=$!
  disown $!
}

kill_daemon() { kill -9 "${node_pids[$1]}"; }

# processes_of NODE prints the processes of a node, whose environment contains its name. The daemon comes first, then
# the processes that watch its tasks. If they are killed in this order, nobody reports the end of a killed task.
processes_of() {
  local file pid
  local -a tasks=() keepers=()
  for file in $(grep -lzxs "SLURMD_NODENAME=$1" /proc/[0-9]*/environ); do
    pid=${file//[!0-9]/}
    tasks+=("$pid")
    pid=$(ps -o ppid= -p "$pid") && pid=${pid// /}
    [[ $(ps -o comm= -p "${pid:-0}") != slurmstepd ]] || keepers+=("$pid")
  done
  echo "${node_pids[$1]} ${keepers[*]} ${tasks[*]}"
}

lose_node() {
  local -a processes
  read -ra processes < <(processes_of "$1")
  kill -9 "${processes[@]}" 2>/dev/null || true
}

# freeze_node NODE SECONDS stops a machine. Slurm treats it as lost. It continues with its tasks after other machines
# have done them.
freeze_node() {
  local -a processes
  read -ra processes < <(processes_of "$1")
  kill -STOP "${processes[@]}" 2>/dev/null
  scontrol update NodeName="$1" State=DOWN Reason=frozen
  {
    sleep "$2"
    kill -CONT "${processes[@]:1}"
    sleep 2
    kill -CONT "${processes[0]}"
    scontrol update NodeName="$1" State=RESUME
  } 2>/dev/null &
}

# give_up_node NODE queues the tasks of a lost node again. Without it, slurmctld would do this after about 15 s.
give_up_node() {
  scontrol update NodeName="$1" State=DOWN Reason=lost
  start_node "$1"
  scontrol update NodeName="$1" State=RESUME
}

start_slurm() {
  local node
  slurm=$farm/slurm
  mkdir -p "$slurm/state"
  chmod 755 "$farm" "$slurm"
  head -c 1024 /dev/urandom >"$slurm/munge.key"
  chmod 400 "$slurm/munge.key"
  write_slurm_conf >"$slurm/slurm.conf"
  export SLURM_CONF=$slurm/slurm.conf
  munged --foreground --force --num-threads=4 --socket="$slurm/munge.socket" --key-file="$slurm/munge.key" \
    --pid-file="$slurm/munged.pid" --seed-file="$slurm/munged.seed" >"$slurm/munged.log" 2>&1 &
  disown $!
  wait_until 10 test -S "$slurm/munge.socket" || slurm_failed "munged does not start"
  slurmctld -D -i >/dev/null 2>&1 &
  disown $!
  for node in "${farm_nodes[@]}"; do
    mkdir -p "$slurm/spool-$node"
    start_node "$node"
  done
  for node in "${farm_nodes[@]}"; do
    wait_until 30 node_is_up "$node" || slurm_failed "$node does not come up"
  done
}
