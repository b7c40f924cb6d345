#!/bin/sh
# test_array.sh BUILD: server/deploy/slurm/zraster.sbatch without Slurm, whose variables are set here and whose scontrol is a fake.
# `make slurm` runs it on Slurm. Prints TAP.
set -u
build=$(realpath "$1") script=$(realpath server/deploy/slurm/zraster.sbatch)
work=$(mktemp -d)
. tests/support/verdict.sh
. tests/support/files.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
unset ZRASTER_SERVER
export ZRASTER="$build/zraster" PATH="$work/bin:$PATH"
mkdir "$work/bin" "$work/in"
printf '#!/bin/sh\necho "$@" >>"%s/scontrol.txt"\n' "$work" >"$work/bin/scontrol"
chmod +x "$work/bin/scontrol"
cd "$work" || exit 1
for i in 1 2 3 4 5 6 7; do triangle >"in/m$i.stl"; done
ls in/*.stl >list.txt

export SLURM_ARRAY_JOB_ID=17 SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_MAX=2 SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1
task() { # SHARD ARGUMENT...
    SLURM_ARRAY_TASK_ID=$1
    export SLURM_ARRAY_TASK_ID
    shift
    "$script" "$@"
}
for shard in 0 1 2; do check "shard $shard of 3" 0 task $shard list.txt out -s 16; done
verdict "all files are drawn" [ "$(ls out | wc -l)" = 7 ]
verdict "with the options behind the folder" [ "$(size_of_png out/m1.png)" = 16x16 ]
check "a task that begins again" 0 task 0 list.txt out -s 16
verdict "skips what is there" [ "$(grep -c '"status":"skipped"' "$said")" = 3 ]
echo broken >in/m2.stl && rm out/m2.png
check "a file that fails ends with 1" 1 task 1 list.txt out -s 16
verdict "and is in the log" grep -q '"file":"in/m2.stl","status":"failed"' "$said"
check "an unknown option ends with 2" 2 task 0 list.txt out --lok clay

check "an array that begins with 1 is refused" 2 env SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=3 SLURM_ARRAY_TASK_ID=1 "$script" list.txt gap
verdict "by name" grep -q 'counts from 1 to 3 in 3 tasks' "$complained"
check "as is one with gaps" 2 env SLURM_ARRAY_TASK_MAX=4 SLURM_ARRAY_TASK_ID=4 "$script" list.txt gap
check "unless the number of shards is given" 0 env ZRASTER_SHARDS=7 SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_MAX=4 SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_ID=4 \
    "$script" list.txt gap -s 16
verdict "so that one shard is repeated" [ "$(ls gap)" = m5.png ]
check "a job that is no array is refused" 2 env -u SLURM_ARRAY_TASK_ID "$script" list.txt gap
check "as is a missing list" 2 task 0 none.txt gap
check "and a missing folder" 2 task 0 list.txt

# A signal while it draws, at any time.
for signal in USR1 TERM; do
    rm -rf long scontrol.txt
    SLURM_ARRAY_TASK_ID=0 "$script" list.txt long -s 4000 >"$said" 2>"$complained" &
    task=$!
    within 10 eval 'pgrep -P $task zraster >/dev/null'
    sleep 0.3
    kill -$signal $task
    wait $task
    verdict "SIG$signal ends a task with 130" [ $? = 130 ]
    verdict "and leaves nothing incomplete" eval 'for f in long/*; do [ ! -e "$f" ] || is_png "$f" || exit 1; done'
    [ $signal = TERM ] || verdict "it queues itself again" [ "$(cat scontrol.txt)" = "requeue 17_0" ]
done
verdict "after SIGTERM, it does not" [ ! -e scontrol.txt ]
verdicts
