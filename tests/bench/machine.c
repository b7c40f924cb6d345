#include "bench/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char isa_variable[] = "ZRASTER_ISA";

bool machine_use_isa(const char *name)
{
    enum zr_isa isa;
    return zr_isa_choose(name, &isa) && setenv(isa_variable, name, 1) == 0;
}

enum zr_isa machine_isa(void)
{
    enum zr_isa isa;
    const char *name = getenv(isa_variable);
    return name && zr_isa_choose(name, &isa) ? isa : zr_isa_best();
}

const char *machine_isa_name(void)
{
    return zr_isa_name(machine_isa());
}

bool machine_has_bars(void)
{
    const enum zr_isa isa = machine_isa();
    return isa == zr_isa_best() || (isa != ZR_ISA_SCALAR && isa != ZR_ISA_SSE2);
}

double machine_bar_divisor(void)
{
    return machine_isa() == ZR_ISA_AVX512 ? 1.0 : 1.6;
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
