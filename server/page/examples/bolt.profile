# A bolt with a hexagonal head.
sides 6
0 -3 c
4 -3 c
4 -0.4 c
3.5 0.1 c
0 0.1 c
