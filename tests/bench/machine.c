#include "bench/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *machine_isa(void)
{
#if defined __x86_64__ || defined __i386__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        return "avx512";
    return __builtin_cpu_supports("avx2") ? "avx2" : "sse2";
#elif defined __aarch64__
    return "neon";
#else
    return "scalar";
#endif
}

double machine_bar_divisor(void)
{
    return strcmp(machine_isa(), "avx512") == 0 ? 1.0 : 1.6;
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
