#include "bench/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/isa.h"

const char *machine_isa(void)
{
    return zr_isa_name(zr_isa_best());
}

double machine_bar_divisor(void)
{
    return zr_isa_best() == ZR_ISA_AVX512 ? 1.0 : 1.6;
}

int machine_cores(void)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : (int)cores;
}

const char *machine_processor(void)
{
    static char name[128] = "unknown processor";
    char line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "model name : %127[^\n]", name) == 1) break;
    if (file) fclose(file);
    return name;
}

double machine_load(void)
{
    double load = -1.0;
    return getloadavg(&load, 1) == 1 ? load : -1.0;
}
