# The shell of an egg, 2.8 high, that stands a little below the ground: outside upwards, then inside downwards.
0 -.12 c
.4 -.06
.8 .17
1.04 .56
1.1 1
1.02 1.5
.82 2
.52 2.42
.25 2.62
0 2.68 c
0 2.6 c
.22 2.54
.47 2.35
.75 1.95
.94 1.47
1.02 1
.96 .59
.74 .23
.37 .02
0 -.04 c
