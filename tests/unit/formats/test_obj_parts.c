/* OBJ in parts of any size, read by several threads. */
#define ZR_OBJ_PART_BYTES part_bytes
#include "unit/common/part_texts.h"

#include "input/obj/obj.c"
#include "support/input/mtl_pictures.h"
#include "support/tests.h"

static const char begin[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\n";
static const char *const pieces[] = {
    "v 0.25 -1 1e-3\n", "v 1 2 3\r\n", "v\t3 2 1 \n", "v 0 0 0 0.5 0.25 1\n", "v 1 \\\n 0 \\\r\n 1\n", "vn 0 1 0\n",
    "vn 0 0 -1 # 1 2 3\n", "vt 0.5 1\n", "f 1 2 3\n", "f -1 -2 -3\n", "f 3 2 1 2\n", "f 1//1 2//1 3//-1\n",
    "f 1/7/1 2//1 3\n", "f 3 \\\n 2 1\n", "f 1 2 -1 # a face\n", "o f 1 2 3\n", "usemtl v\n", "s off\n", "\n",
    "#f 1 2\n", "# C:\\\n", "g a \\\n#\n", "l 1 2\n", "p 1\n", "l 1/1 -1 2 9\n", "p 3 -1\n", "s 1\n", "s 12\n",
    "f 1// 2/7/ 3//9\n", "vn nan 0 1\n", "vt x\n", "v 0 0 0 51 1.5 0\n", "v 2e6 1e7 0\n", "who\n", "usemtl a\\\n",
    "# a\rv 0 0 1\n", "mtllib m.mtl\n", "usemtl w x\n", "o\n", "g f\n", "vt 1 0\n", "f 1/1 2/2 3/-1\n",
    "g any any any any any any any any any any any\n",
    /* faults that reading goes on behind, and bad syntax */
    "f 1 2 99999999\n", "f 1 2 -99999999\n", "f 1 2\n", "v 0 1e20 0\n", "v 0 0 0 1 1 300\n", "f 1 2 3 4/x\n",
    "f 1 2 x\n"};
enum { PIECES = sizeof pieces / sizeof *pieces, GOOD = PIECES - 7 };

TEST(any_text_is_the_same_in_parts)
{
    check_texts(ZR_FORMAT_OBJ, begin, pieces, GOOD, "");
}

/* Puts `begin` and any of the first `most` pieces. */
static void put_pieces(struct text *text, const char *begin_with, size_t most)
{
    put(text, begin_with, strlen(begin_with));
    for (size_t k = 0; k < PIECES_MOST; k++) {
        const char *piece = pieces[below(below(4) ? GOOD : most)];
        put(text, piece, strlen(piece));
    }
}

TEST(any_text_with_materials_is_the_same_in_parts)
{
    static const char mtl[] = "newmtl v\nmap_Kd c.png\nnewmtl w x\nKd 1 0 0\n",
                      with_materials[] =
                          "mtllib m.mtl\nusemtl v\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\n";
    static const struct zr_asset assets[] = {
        {.name = "m.mtl", .bytes = mtl, .size = sizeof mtl - 1},
        {.name = "c.png", .bytes = PICTURE_COLORS, .size = sizeof PICTURE_COLORS - 1}};
    size_t good = 0;
    team_assets = assets;
    team_asset_count = sizeof assets / sizeof *assets;
    for (int i = 0; i < TEXTS / 8; i++) {
        struct text text = {0};
        put_pieces(&text, with_materials, GOOD);
        check_text(ZR_FORMAT_OBJ, &text, &good);
        drop(&text);
    }
    team_asset_count = 0;
    assert_true(good > TEXTS / 16);
}

TEST(faults_are_the_same_in_their_order_with_their_lines)
{
    size_t good = 0;
    for (int i = 0; i < TEXTS / 4; i++) {
        struct text text = {0};
        put_pieces(&text, begin, PIECES);
        check_text(ZR_FORMAT_OBJ, &text, &good);
        drop(&text);
    }
    assert_true(good < TEXTS / 8);
}

TEST(cancelled_reader_says_so)
{
    struct text text = {0};
    for (int i = 0; i < 5000; i++)
        add(&text, "v 0 0 0\nf -1 -1 -1\n");
    check_cancelled(ZR_FORMAT_OBJ, &text);
    drop(&text);
}

RUN_TESTS(start_teams, end_teams)
