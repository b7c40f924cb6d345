# A ball of radius 0.45 that stands on the ground.
0 0 c
.172 .034
.318 .132
.416 .278
.45 .45
.416 .622
.318 .768
.172 .866
0 .9 c
