# The cage that keeps the balls apart.
15.4 4.6 c
18.1 4.6 c
18.1 9.4 c
15.4 9.4 c
15.4 4.6 c
