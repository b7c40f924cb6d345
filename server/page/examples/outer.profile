# The outer ring of a ball bearing: 47 wide, 14 high, with the groove of the balls.
19.6 0 c
23 0 c
23.5 0.5 c
23.5 13.5 c
23 14 c
19.6 14 c
19.6 9.88 c
20.26 9.02
20.66 8.05
20.8 7
20.66 5.95
20.26 4.98
19.6 4.12 c
19.6 0 c
