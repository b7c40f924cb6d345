#include "bench/results.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct {
    const char *name, *of;
} sides[] = {[ROW_BYTES] = {"bytes", "theirs"}, [ROW_MEMORY] = {"memory", "the scene's arrays"}};

void results_free(struct results *results)
{
    free(results->rows);
    *results = (struct results){.rows = NULL};
}

void results_add(struct results *results, const struct row *row)
{
    if (results->count == results->room) {
        int room = results->room * 2 + 64;
        struct row *rows = realloc(results->rows, (size_t)room * sizeof *rows);
        if (!rows) {
            results->failed = true;
            return;
        }
        results->rows = rows;
        results->room = room;
    }
    results->rows[results->count] = *row;
    results->rows[results->count++].table = results->table;
}

static double ratio_of(const struct row *row)
{
    return row->theirs_ms > 0 && row->ours_ms > 0 ? row->theirs_ms / row->ours_ms : 0.0;
}

static bool has_bar(const struct row *row)
{
    return row->bar.must > 0 || row->side_bar.must > 0;
}

static bool reaches(const struct row *row, double least, double most)
{
    return (least <= 0 || ratio_of(row) >= least) && (most <= 0 || row->side_ratio <= most);
}

static bool is_short(const struct row *row)
{
    return has_bar(row) && !reaches(row, row->bar.must, row->side_bar.must);
}

static bool has_goal(const struct row *row)
{
    return row->bar.goal > 0 || row->side_bar.goal > 0;
}

static const char *mark(const struct row *row)
{
    if (row->wrong) return "WRONG";
    if (is_short(row)) return "SHORT";
    if (has_goal(row) && reaches(row, row->bar.goal, row->side_bar.goal)) return "goal";
    return has_bar(row) ? "ok" : "";
}

/* ---- the table ---- */

static void print_number(double value, const char *unit, int width, int digits)
{
    char text[40] = "-";
    if (value > 0) snprintf(text, sizeof text, "%.*f%s", digits, value, unit);
    printf(" %*s", width, text);
}

void results_print_legend(void)
{
    fputs(
        "Times are medians, both sides in turns. ratio: theirs over ours, more is better; must: the ratio that has "
        "to be\n"
        "reached; goal: what we aim at. Marks: SHORT: must, or an \"at most\" behind it, is missed; ok: it is not; "
        "goal:\n"
        "the goal is reached, too; WRONG: the results differ, and the times mean nothing.\n"
        "1T, 2T: threads. ids: face ids are written, too. frame after it: the same side's next one, whose caches the\n"
        "other side has not emptied, as in a stream of frames.\n",
        stdout);
}

void results_begin_table(struct results *results, const char *heading)
{
    if (results->table && strcmp(results->table, heading) == 0) return;
    results->table = heading;
    printf("\n%-57s %9s %9s %8s %6s %6s mark\n", heading, "ours ms", "theirs ms", "ratio", "must", "goal");
    fflush(stdout);
}

/* What stands behind the mark; "" for most rows. */
static void describe(const struct row *row, char *text, size_t size)
{
    int used = 0;
    text[0] = '\0';
    if (row->side != ROW_TIME_ONLY)
        used = snprintf(text, size, "%s %.2fx of %s", sides[row->side].name, row->side_ratio, sides[row->side].of);
    if (row->side_bar.must > 0)
        used += snprintf(text + used, size - (size_t)used, " (at most %.1fx)", row->side_bar.must);
    snprintf(text + used, size - (size_t)used, "%s%s", used > 0 && row->note[0] ? ", " : "", row->note);
}

void results_print_row(const struct row *row)
{
    int digits = row->ours_ms < 1.0 ? 4 : row->ours_ms < 100.0 ? 3 : 1;
    char rest[200];
    describe(row, rest, sizeof rest);
    printf("%-57s", row->work);
    print_number(row->ours_ms, "", 9, digits);
    print_number(row->theirs_ms, "", 9, digits);
    print_number(ratio_of(row), "x", 8, 2);
    print_number(row->bar.must, "x", 6, 2);
    print_number(row->bar.goal, "x", 6, 2);
    if (rest[0])
        printf(" %-5s %s\n", mark(row), rest);
    else
        printf("%s%s\n", mark(row)[0] ? " " : "", mark(row));
    fflush(stdout);
}

void results_print_summary(const struct results *results)
{
    int bars = 0, musts = 0, goals = 0, goals_reached = 0, wrong = 0;
    for (int i = 0; i < results->count; i++) {
        const struct row *row = &results->rows[i];
        wrong += row->wrong;
        bars += has_bar(row);
        musts += has_bar(row) && !row->wrong && !is_short(row);
        goals += has_goal(row);
        goals_reached += has_goal(row) && !row->wrong && reaches(row, row->bar.goal, row->side_bar.goal);
    }
    printf("\n%d rows: %d of %d reach what they must, %d of %d reach the goal, %d wrong%s\n", results->count, musts,
           bars, goals_reached, goals, wrong, results->failed ? "; something could not run" : "");
}

/* ---- the file ---- */

static void write_number(FILE *out, const char *key, double value)
{
    if (value > 0)
        fprintf(out, ", \"%s\": %.6g", key, value);
    else
        fprintf(out, ", \"%s\": null", key);
}

/* Of ASCII, without control characters. */
static void write_string(FILE *out, const char *key, const char *value)
{
    fprintf(out, "\"%s\": \"", key);
    for (; *value; value++)
        fprintf(out, *value == '"' || *value == '\\' ? "\\%c" : "%c", *value);
    fputs("\"", out);
}

static void write_row(FILE *out, const struct row *row)
{
    fputs("{", out);
    write_string(out, "table", row->table ? row->table : "");
    fputs(", ", out);
    write_string(out, "work", row->work);
    write_number(out, "ours_ms", row->ours_ms);
    write_number(out, "theirs_ms", row->theirs_ms);
    write_number(out, "ratio", ratio_of(row));
    write_number(out, "must", row->bar.must);
    write_number(out, "goal", row->bar.goal);
    if (row->side != ROW_TIME_ONLY) {
        char key[32];
        snprintf(key, sizeof key, "%s_ratio", sides[row->side].name);
        write_number(out, key, row->side_ratio);
        snprintf(key, sizeof key, "%s_must", sides[row->side].name);
        write_number(out, key, row->side_bar.must);
        snprintf(key, sizeof key, "%s_goal", sides[row->side].name);
        write_number(out, key, row->side_bar.goal);
    }
    fputs(", ", out);
    write_string(out, "mark", mark(row));
    fputs(", ", out);
    write_string(out, "note", row->note);
    fputs("}", out);
}

static void make_directories(const char *path)
{
    char part[600];
    for (const char *slash = strchr(path, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof part, "%.*s", (int)(slash - path), path);
        if (part[0]) mkdir(part, 0777);
    }
}

bool results_write(const struct results *results, const char *path)
{
    make_directories(path);
    FILE *out = fopen(path, "w");
    if (!out) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return false;
    }
    fputs("{", out);
    write_string(out, "processor", results->processor);
    fprintf(out, ", \"cores\": %d, ", results->cores);
    write_string(out, "isa", results->isa);
    fputs(", ", out);
    write_string(out, "renderer", results->renderer);
    fputs(",\n \"rows\": [", out);
    for (int i = 0; i < results->count; i++) {
        fputs(i ? ",\n  " : "\n  ", out);
        write_row(out, &results->rows[i]);
    }
    fputs("\n]}\n", out);
    if (fclose(out) == 0) return true;
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    return false;
}

int results_status(const struct results *results)
{
    for (int i = 0; i < results->count; i++)
        if (results->rows[i].wrong) return 1;
    return results->failed ? 1 : 0;
}
