#include "base/sort.h"

enum { FEW = 24 };

static void sift(uint64_t *values, uint32_t at, uint32_t count)
{
    const uint64_t value = values[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && values[child + 1] > values[child]) child++;
        if (values[child] <= value) break;
        values[at] = values[child];
    }
    values[at] = value;
}

static void insert(uint64_t *values, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const uint64_t value = values[i];
        uint32_t at = i;
        for (; at > 0 && values[at - 1] > value; at--)
            values[at] = values[at - 1];
        values[at] = value;
    }
}

void zr_sort_u64(uint64_t *values, uint32_t count)
{
    if (count <= FEW) {
        insert(values, count);
        return;
    }
    for (uint32_t i = count / 2; i-- > 0;)
        sift(values, i, count);
    for (uint32_t i = count - 1; i > 0; i--) {
        const uint64_t most = values[0];
        values[0] = values[i];
        values[i] = most;
        sift(values, 0, i);
    }
}
