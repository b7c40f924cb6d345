# The inner ring of a ball bearing: for a shaft of 20.
10 0 c
13.9 0 c
13.9 4.12 c
13.24 4.98
12.84 5.95
12.7 7
12.84 8.05
13.24 9.02
13.9 9.88 c
13.9 14 c
10 14 c
10 0 c
