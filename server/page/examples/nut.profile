# A hexagonal nut.
sides 6
7 30.9 c
12 30.9 c
12.6 31.6 c
12.6 35.4 c
12 36.1 c
7 36.1 c
7 30.9 c
