#include "output/huffman.h"

#include <stddef.h>

enum { LENGTH_MAX = 15, NODES_MAX = 2 * ZR_HUFFMAN_SYMBOLS_MAX };

/* Symbols that occur, rarest first: the count above, the symbol in the lower 16 bits, so that
 * the order of equal counts is settled too. Shell's sort: a few hundred of them, nearly sorted. */
static int sort_symbols(const uint32_t *counts, int count, uint64_t *keys)
{
    int used = 0;
    for (int i = 0; i < count; i++)
        if (counts[i]) keys[used++] = (uint64_t)counts[i] << 16 | (uint64_t)i;
    static const int gaps[] = {132, 57, 23, 10, 4, 1};
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (int gap = gaps[g], i = gap; i < used; i++) {
            uint64_t key = keys[i];
            int to = i;
            for (; to >= gap && keys[to - gap] > key; to -= gap)
                keys[to] = keys[to - gap];
            keys[to] = key;
        }
    return used;
}

/* Two queues: the leaves, sorted, and the inner nodes, which come sorted. Counts how many leaves
 * are how deep, those that are too deep as deep as may be. */
static void count_depths(const uint64_t *keys, int used, int longest, int *depth_counts)
{
    uint32_t weights[NODES_MAX];
    uint16_t parents[NODES_MAX];
    uint8_t depths[NODES_MAX];
    for (int i = 0; i < used; i++)
        weights[i] = (uint32_t)(keys[i] >> 16);
    int leaf = 0, inner = used, end = used;
    for (; end < 2 * used - 1; end++) {
        weights[end] = 0;
        for (int child = 0; child < 2; child++) {
            int node = leaf < used && (inner >= end || weights[leaf] <= weights[inner]) ? leaf++ : inner++;
            weights[end] += weights[node];
            parents[node] = (uint16_t)end;
        }
    }
    depths[end - 1] = 0;
    for (int i = end - 2; i >= 0; i--) {
        int depth = depths[parents[i]] + 1;
        depths[i] = (uint8_t)(depth < UINT8_MAX ? depth : UINT8_MAX);
        if (i < used) depth_counts[depth < longest ? depth : longest]++;
    }
}

/* Leaves moved up to `longest` ask for more than there is: for each too much, a shorter code is
 * made longer by one and takes a long one as its neighbour. */
static void make_room(int *depth_counts, int longest)
{
    uint32_t taken = 0;
    for (int i = 1; i <= longest; i++)
        taken += (uint32_t)depth_counts[i] << (longest - i);
    for (; taken > 1u << longest; taken--) {
        int i = longest - 1;
        while (depth_counts[i] == 0)
            i--;
        depth_counts[longest]--;
        depth_counts[i]--;
        depth_counts[i + 1] += 2;
    }
}

int zr_huffman_lengths(const uint32_t *counts, int count, int longest, uint8_t *lengths)
{
    uint64_t keys[ZR_HUFFMAN_SYMBOLS_MAX];
    int depth_counts[LENGTH_MAX + 1] = {0};
    for (int i = 0; i < count; i++)
        lengths[i] = 0;
    int used = sort_symbols(counts, count, keys);
    if (used == 1) lengths[keys[0] & 0xffff] = 1;
    if (used < 2) return used;
    count_depths(keys, used, longest, depth_counts);
    make_room(depth_counts, longest);
    int next = 0;
    for (int length = longest; length > 0; length--)
        for (int i = 0; i < depth_counts[length]; i++)
            lengths[keys[next++] & 0xffff] = (uint8_t)length;
    return used;
}

static uint16_t reversed(uint32_t code, int length)
{
    uint32_t out = 0;
    for (int i = 0; i < length; i++)
        out |= (code >> i & 1) << (length - 1 - i);
    return (uint16_t)out;
}

void zr_huffman_codes(const uint8_t *lengths, int count, uint16_t *codes)
{
    uint32_t of_length[LENGTH_MAX + 1] = {0}, next[LENGTH_MAX + 1] = {0};
    for (int i = 0; i < count; i++)
        of_length[lengths[i]]++;
    of_length[0] = 0;
    for (int i = 1; i <= LENGTH_MAX; i++)
        next[i] = (next[i - 1] + of_length[i - 1]) << 1;
    for (int i = 0; i < count; i++)
        codes[i] = lengths[i] ? reversed(next[lengths[i]]++, lengths[i]) : 0;
}
