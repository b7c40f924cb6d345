# A gear of 26 teeth with a hub.
teeth 26 3.4
10 14.4 c
14 14.4 c
14 17 c
25.6 17 c
27 17 t
27 27 t
21 27 c
20 25 c
14.5 25 c
14 29.6 c
13.4 30.2 c
10 30.2 c
10 14.4 c
