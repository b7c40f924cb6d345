# A shaft of 20 with a shoulder and a thinner end.
0 -17 c
12.4 -17 c
13 -16.4 c
13 0 c
10 0 c
10 30 c
9.2 30.8 c
7 30.8 c
7 37 c
6.3 37.8 c
0 37.8 c
