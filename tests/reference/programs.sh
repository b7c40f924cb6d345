#!/bin/sh
# programs.sh BUILD: prints the folder of the zraster-verify that draws lines by the rule of the Mesa at hand: BUILD, or
# BUILD/mutant where Mesa is older than 25.0.
rule=$("$1/zraster-verify" --line-rule) || exit
if [ "$rule" = older ]; then echo "$1/mutant"; else echo "$1"; fi
