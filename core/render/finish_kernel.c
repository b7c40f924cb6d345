#include "render/finish.h"

#include "base/simd/pow_simd.h"
#include "base/simd/simd.h"
#include "base/srgb_color_simd.h"

/* ZR_LANES pixels, premultiplied. */
struct pixels {
    zr_vf color[3], opacity;
};

/* Returns the opacity of the ground's shadow over a transparent background: 1 - T^(1/2.2). */
static inline zr_vf shadow_opacity(zr_vf share)
{
    const zr_vf one = zr_vf_set(1.0f);
    return one - zr_vf_select(zr_vf_lt(share, one), zr_pow_v(share, zr_vf_set(1.0f / 2.2f)), one);
}

/* Returns the background, darkened by the ground's shadow. */
static inline struct pixels behind_of(const struct zr_finish_row *row, uint32_t x)
{
    const zr_vf one = zr_vf_set(1.0f), own = zr_vf_set(row->background[3]);
    const zr_vf share = row->share ? zr_vf_load(row->share + x) : one;
    struct pixels out;
    for (int k = 0; k < 3; k++)
        out.color[k] = zr_vf_set(row->background[k] * row->background[3]) * share;
    out.opacity = own;
    if (row->share && row->background[3] < 1.0f) out.opacity = own + shadow_opacity(share) * (one - own);
    return out;
}

static inline struct pixels pixels_of(const struct zr_finish_row *row, uint32_t x)
{
    const zr_vf one = zr_vf_set(1.0f), cover = zr_vf_load(row->cover + x), rest = one - cover;
    struct pixels out = behind_of(row, x);
    for (int k = 0; k < 3; k++)
        out.color[k] = zr_vf_load(row->color[k] + x) + out.color[k] * rest;
    out.opacity = cover + out.opacity * rest;
    if (!row->ink) return out;
    const zr_vf ink = zr_vf_load(row->ink + x), kept = one - ink;
    for (int k = 0; k < 3; k++)
        out.color[k] = out.color[k] * kept + zr_vf_set(row->ink_color[k]) * ink;
    out.opacity = out.opacity * kept + ink;
    return out;
}

/* Returns what dithering adds to encoded values. */
static inline zr_vf dither_of(const struct zr_finish_row *row, uint32_t x)
{
    const zr_vf zero = zr_vf_set(0.0f);
    const zr_vm covered = zr_vf_lt(zero, zr_vf_load(row->cover + x));
    const zr_vf moved = zr_vf_load(row->dither + x % ZR_DITHER_ROOM);
    return ZR_MUTANT(dithered_surfaces, zr_vf_select(covered, zero, moved), moved);
}

/* Encodes as bytes with straight alpha. Pixels of opacity 0 are black. */
static inline zr_vi bytes_of(const struct zr_finish_row *row, uint32_t x, const struct pixels *p)
{
    const zr_vm seen = zr_vf_lt(zr_vf_set(0.0f), p->opacity);
    const zr_vf opacity = zr_vf_select(seen, p->opacity, zr_vf_set(1.0f));
    zr_vi bytes[4];
    for (int k = 0; k < 3; k++) {
        const zr_vf encoded = zr_srgb_encode_v(p->color[k] / opacity);
        bytes[k] = zr_rgba_bytes_v(row->dither ? encoded + dither_of(row, x) : encoded);
    }
    bytes[3] = zr_rgba_bytes_v(p->opacity);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | bytes[3] << 24;
#else
    return bytes[0] << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
#endif
}

/* Returns true if the lanes show neither surface nor shadow nor ink. */
static inline bool shows_background_alone(const struct zr_finish_row *row, uint32_t x)
{
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vm others = zr_vf_lt(zero, zr_vf_load(row->cover + x));
    if (row->share) others = zr_vm_or(others, zr_vf_lt(zr_vf_load(row->share + x), zr_vf_set(1.0f)));
    if (row->ink) others = zr_vm_or(others, zr_vf_lt(zero, zr_vf_load(row->ink + x)));
    return !zr_vm_any(zr_vm_and(others, zr_vm_first(row->count - x)));
}

/* Vectors until a row of the background repeats. */
enum { REPEATED = ZR_LANES < ZR_DITHER_SIDE ? ZR_DITHER_SIDE / ZR_LANES : 1 };

/* A row of the background is encoded once (saves an eighth of a picture's time if half of it is empty). */
void ZR_KERNEL(zr_finish_row)(const struct zr_finish_row *row, uint32_t *out)
{
    zr_vi backgrounds[REPEATED];
    for (int i = 0; i < REPEATED; i++)
        backgrounds[i] = zr_vi_set(0);
    bool has_background[REPEATED] = {false};
    for (uint32_t x = 0; x < row->count; x += ZR_LANES) {
        const bool is_empty = shows_background_alone(row, x);
        const uint32_t place = x / ZR_LANES % REPEATED;
        zr_vi bytes;
        if (is_empty && has_background[place]) {
            bytes = backgrounds[place];
        } else {
            const struct pixels pixels = pixels_of(row, x);
            bytes = bytes_of(row, x, &pixels);
        }
        if (is_empty) backgrounds[place] = bytes;
        has_background[place] |= is_empty;
        zr_vi_store_first(out + x, bytes, row->count - x < ZR_LANES ? row->count - x : ZR_LANES);
    }
}

void ZR_KERNEL(zr_decode)(const float encoded[3], float linear[3])
{
    for (int k = 0; k < 3; k++) {
        float lanes[ZR_LANES];
        zr_vf_store(lanes, zr_srgb_decode_v(zr_vf_set(encoded[k])));
        linear[k] = lanes[0];
    }
}
