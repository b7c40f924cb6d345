# A housing with a flange and a seat for the bearing.
sides 72
13.6 -9 c
41 -9 c
42 -8 c
42 -4 c
41 -3 c
31 -3
29.6 -2
29 0
28.6 11
28 12.6
26.5 13.2 c
23.5 13.2 c
23.5 0 c
18.5 0 c
18.5 -4 c
13.6 -4 c
13.6 -9 c
