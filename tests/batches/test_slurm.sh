#!/bin/sh
# test_slurm.sh BUILD: server/deploy/slurm/zraster.sbatch on Debian's Slurm: a controller and two nodes on this machine draw 200 files
# in 20 shards. One node ends by kill -9 in between, with all that it runs, and one task is told to queue itself again. Nothing is lost, and
# nothing is drawn twice. All of it runs in namespaces of its own: needs root. Prints TAP.
set -u
files=200 shards=20
build=$(realpath "$1")
. tests/support/verdict.sh
PATH=$PATH:/usr/sbin
for program in slurmctld slurmd sbatch munged unshare ip; do
    command -v $program >/dev/null || missing="${missing:-} $program"
done
[ "$(id -u)" = 0 ] || missing="${missing:-} root"
if [ -n "${missing:-}" ]; then
    skip "an array of Slurm jobs" "missing:$missing (apt-get install slurm-wlm munge iproute2)"
    verdicts
    exit
fi
if [ -z "${SLURM_TEST_FOLDER:-}" ]; then
    SLURM_TEST_FOLDER=$(mktemp -d)
    export SLURM_TEST_FOLDER
    trap 'rm -rf "$SLURM_TEST_FOLDER"' EXIT
    timeout 400 unshare --mount --net --pid --fork --mount-proc --kill-child "$0" "$1"
    exit
fi
work=$SLURM_TEST_FOLDER script=$PWD/server/deploy/slurm/zraster.sbatch
said=$work/said complained=$work/complained
: >"$said"
: >"$complained"
cd "$work" || exit 1

# ---- a cluster ----

ip link set lo up
ip addr add 10.99.0.1/32 dev lo # names are not resolved where there is no address but 127.0.0.1
mkdir -m 700 munge
mkdir state spool-node1 spool-node2
head -c 1024 /dev/urandom >munge/key
chmod 400 munge/key
# It refuses folders that others may write to.
chmod 755 "$work"
munged --force --key-file "$work/munge/key" --socket "$work/munge/socket" --pid-file "$work/munge/pid" --log-file "$work/munge/log" \
    --seed-file "$work/munge/seed" || exit 1
cat >slurm.conf <<END
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdTimeout=5
ReturnToService=2
MinJobAge=600
NodeName=node[1-2] NodeHostname=localhost NodeAddr=127.0.0.1 Port=17001-17002 CPUs=2 RealMemory=16000
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
END
export SLURM_CONF=$work/slurm.conf
slurmctld -D >ctld.out 2>&1 &
start_node() { # NAME
    slurmd -D -N "$1" >>"$1.out" 2>&1 &
    echo $! >"$1.pid"
}
start_node node1
start_node node2
are_idle() { [ "$(sinfo -h -N -t idle 2>/dev/null | wc -l)" = 2 ]; }
verdict "two nodes are there" within 30 are_idle

# ---- a job ----

mkdir models
for i in $(seq -w $files); do
    awk -v seed="$i" 'BEGIN { for (k = 0; k < 400; k++) { a = k * 2.4 + seed; print "v", cos(a) * k, sin(a) * k, (k * seed) % 97 }
        for (k = 1; k < 399; k++) print "f", k, k + 1, k + 2 }' >"models/m$i.obj"
done
find "$work/models" -name '*.obj' | LC_ALL=C sort >list.txt
"$build/zraster" batch - -o whole -q -s 800 <list.txt || exit 1
job=$(ZRASTER=$build/zraster sbatch --parsable --array=0-$((shards - 1)) --cpus-per-task=1 --mem=500M "$script" list.txt "$work/pictures" -s 800)
count_pictures() { find pictures -name '*.png' 2>/dev/null | wc -l; }
some_are_drawn() { [ "$(count_pictures)" -ge $1 ]; }
verdict "an array begins" within 60 some_are_drawn 8

# What a node runs has its name in the environment; above that is a slurmstepd.
end_node() { # NAME
    kill -9 "$(cat "$1.pid")"
    for process in /proc/[0-9]*; do
        grep -qz "^SLURMD_NODENAME=$1$" "$process/environ" 2>/dev/null || continue
        parent=$(awk '{ print $4 }' "$process/stat")
        [ "$(cat "/proc/$parent/comm" 2>/dev/null)" = slurmstepd ] && kill -9 "$parent"
        kill -9 "${process#/proc/}"
    done
}
running=$(squeue -h -r -t R -w node2 | wc -l)
end_node node2
at=$(count_pictures)
verdict "a node ends while it draws: $running tasks, $at of $files pictures are there" [ "$running" -gt 0 -a "$at" -lt $files ]
# As before the end of its time. scancel asks again if the task is gone at once.
timeout 2 scancel --batch --signal=USR1 "${job}_$(squeue -h -r -t R -o %K -w node1 | head -n 1)" 2>"$complained"
is_down() { scontrol show node node2 | grep -q 'State=DOWN'; }
verdict "Slurm notices" within 60 is_down
start_node node2
is_over() { [ -z "$(squeue -h)" ]; }
verdict "and the job ends" within 300 is_over

# ---- the result ----

verdict "each picture is there, byte by byte, and nothing else" diff -r whole pictures
verdict "each shard has a log" [ "$(ls zraster-*.log | wc -l)" = $shards ]
cat zraster-*.log | grep '^{' >lines.txt
status_of() { grep -c "\"status\":\"$1\"" lines.txt; }
verdict "whose lines are whole" python3 -c 'import json; [json.loads(line) for line in open("lines.txt")]'
done=$(status_of done)
verdict "no file was drawn twice" [ "$(grep '"status":"done"' lines.txt | cut -d '"' -f 4 | sort | uniq -d | wc -l)" = 0 ]
verdict "all lines together name all files" [ "$(cut -d '"' -f 4 lines.txt | sort -u | wc -l)" = $files ]
verdict "$done are done; only a task of the lost node may lack its line" [ "$done" -ge $((files - running)) ]
verdict "tasks that began again skipped $(status_of skipped) files" [ "$(status_of skipped)" -gt 0 ]
verdict "no file failed" [ "$(status_of failed)" = 0 ]
scontrol show job "$job" -o >jobs.txt
verdict "each task ended with 0" [ "$(grep -c 'JobState=COMPLETED .* ExitCode=0:0' jobs.txt)" = $shards ]
verdict "$(grep -c 'Restarts=[1-9]' jobs.txt) tasks began again" [ "$(grep -c 'Restarts=[1-9]' jobs.txt)" -ge $((running + 1)) ]

sbatch -W --array=1-3 -o gap.log --wrap "ZRASTER=$build/zraster $script list.txt gap" >"$said" 2>"$complained"
verdict "an array that does not count from 0 is refused" grep -q 'the array counts from 1 to 3 in 3 tasks, not from 0 without gaps' gap.log
verdict "and draws nothing" [ ! -e gap ]
cp jobs.txt slurmctld.log node*.out zraster-*.log "$build/test-logs/" 2>/dev/null
verdicts
