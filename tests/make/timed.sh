#!/bin/sh
# timed.sh LOG [TARGET] -c COMMAND: the shell of `make times`. Runs the command, and adds three lines to a file of the folder LOG: the target
# and, as `times` prints them, the processor time of this shell and that of the command.
log=$1 target=$2
for command; do :; done
/bin/sh -c "$command"
status=$?
if [ "$target" != -c ]; then
    echo "$target" >>"$log/$$"
    times >>"$log/$$"
fi
exit $status
