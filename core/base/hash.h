/* hash.h - base: hashes of the keys of tables, not of secrets. Source: FNV-1a of 32 bits. Strong hashes come from the
 * caller. */
#ifndef ZR_HASH_H
#define ZR_HASH_H

#include <stdint.h>

/* Strong hash of a file, such as its SHA-256. */
struct zr_file_hash {
    unsigned char bytes[32];
};

#define ZR_HASH_BEGIN 2166136261u

static inline uint32_t zr_hash_byte(uint32_t hash, uint8_t byte)
{
    return (hash ^ byte) * 16777619u;
}

/* Hashes a word at once. Its upper half is folded into the lower one, which reaches more bits of the product. */
static inline uint32_t zr_hash_word(uint32_t hash, uint32_t word)
{
    return (hash ^ word ^ word >> 16) * 16777619u;
}

#endif
