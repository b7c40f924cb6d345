/* command_rows.h - client: commands and their options, one row each. Parser, help, completion and man page follow from
 * the rows. Parameters of pictures are options, too (core/parameter_rows.h). */
#ifndef COMMAND_ROWS_H
#define COMMAND_ROWS_H

/* ROW(name, letter in the rows of options, arguments, summary); the first one is the default. command_NAME runs it. */
#define COMMAND_ROWS(ROW)                                                                                              \
    ROW(render, 'r', "FILE... [-o OUTPUT] [OPTION]...", "draws models and scenes (default)")                           \
    ROW(info, 'i', "FILE [OPTION]...", "prints the facts of a model or scene: camera, bounds, parts, holes, warnings") \
    ROW(batch, 'b', "FILE|FOLDER|GLOB|-... [-o FOLDER] [OPTION]...",                                                   \
        "draws many files on all cores; -: names, or lines such as {\"file\": \"a.stl\", \"look\": \"clay\"}, from "   \
        "standard input")                                                                                              \
    ROW(views, 'v', "FILE [-o FOLDER/] [OPTION]...",                                                                   \
        "draws several sides: front, top, right and isometric, or --views")                                            \
    ROW(sheet, 's', "FILE [-o OUTPUT] [OPTION]...",                                                                    \
        "draws several sides into one picture at one scale: --sheet threeView or balanced, or --views")                \
    ROW(turntable, 't', "FILE [-o OUTPUT] [OPTION]...",                                                                \
        "draws an animated PNG, WebP or GIF: the camera turns once around FILE")                                       \
    ROW(drawing, 'd', "FILE [-o DRAWING.svg|.png] [OPTION]...",                                                        \
        "draws a technical drawing: front, top, right and isometric view at one standard scale, with hidden lines, "   \
        "sizes and a title block")                                                                                     \
    ROW(compare, 'c', "A B [-o DIFF.png] [OPTION]...",                                                                 \
        "compares two models in numbers, or counts the pixels of two pictures that differ; exit status 4 if they are " \
        "not the same")                                                                                                \
    ROW(watch, 'w', "FILE [-o OUTPUT] [OPTION]...", "draws the file again whenever it changes")                        \
    ROW(mcp, 'm', "--root DIR [OPTION]...",                                                                            \
        "serves the tools render, facts, pick and compare to an agent, by the Model Context Protocol on standard "     \
        "input and "                                                                                                   \
        "output")                                                                                                      \
    ROW(looks, 'l', "", "lists the looks")                                                                             \
    ROW(help, 'h', "[COMMAND|KEY|WORD]",                                                                               \
        "explains a command, a key of scenes, or a word such as masks, nocs, studio or stl")

/* ROW(parameter): those that `zraster drawing` has. The last ones are parameters of drawings (core/drawing_rows.h). */
#define DRAWING_PARAMETER_ROWS(ROW)                                                                                    \
    ROW(member)                                                                                                        \
    ROW(up)                                                                                                            \
    ROW(animation)                                                                                                     \
    ROW(time)                                                                                                          \
    ROW(hide)                                                                                                          \
    ROW(isolate)                                                                                                       \
    ROW(explode)                                                                                                       \
    ROW(explodeAxis)                                                                                                   \
    ROW(scale)                                                                                                         \
    ROW(projection)                                                                                                    \
    ROW(section)                                                                                                       \
    ROW(title)                                                                                                         \
    ROW(dpi)

/* Letters of the commands that draw. They accept parameters of pictures. */
#define DRAWING_COMMANDS "ribwvst"

/* ROW(ID, name, short letter or 0, placeholder or NULL for a switch, letters of its commands, help) */
#define OUTPUT_OPTION_ROWS(ROW)                                                                                        \
    ROW(OUTPUT, "output", 'o', "FILE|DIR|-", "rbcdwvst",                                                                \
        "file, folder or standard output; .svg: lines alone (default: FILE with another ending, in this folder; "      \
        "compare: "                                                                                                    \
        "none)")                                                                                                       \
    ROW(SIZE, "size", 's', "WxH|N", DRAWING_COMMANDS "c",                                                              \
        "window in pixels; N means NxN; for models -W or -H alone keeps 4:3")                                          \
    ROW(NO_CLOBBER, "no-clobber", 'n', NULL, "rbcdwvst", "no overwriting of existing files")                            \
    ROW(SHOW, "show", 0, NULL, "rws", "picture in the terminal (kitty, iTerm2, sixel)")                                \
    ROW(RESUME, "resume", 0, NULL, "b", "only files without outputs of these settings")                                \
    ROW(LIST, "list", 0, "FILE", "b", "more files of the batch, one per line of FILE, as on standard input for -")     \
    ROW(SHARD, "shard", 0, "I/N", "b",                                                                                 \
        "every Nth file of the list, beginning with file I, from 0; the shards 0/N to N-1/N draw each file once")      \
    ROW(JSON, "json", 0, NULL, "ibc", "JSON on standard output: the facts, the numbers, or one line per file")         \
    ROW(EXPECT, "expect", 0, "JSON|FILE", "i",                                                                         \
        "expected facts, such as {\"box\": [40, 24, 12], \"holes\": [{\"diameter\": 5, \"count\": 4}]}; exit status "  \
        "4 if one "                                                                                                    \
        "differs")                                                                                                     \
    ROW(TOLERANCE, "tolerance", 0, "LENGTH", "c",                                                                      \
        "largest distance between surfaces, or steps between colours, that count as the same (default: models: a "     \
        "millionth of the size; pictures: 0)")                                                                         \
    ROW(ALIGN, "align", 0, "HOW", "c",                                                                                 \
        "motion of the second model before: none, bounds, principal or icp (default: none)")                           \
    ROW(RESCALE, "rescale", 0, NULL, "c", "scaling of the second model by --align")                                    \
    ROW(PICTURE, "picture", 0, "KIND", "c",                                                                            \
        "picture of two models for -o: difference, deviation or side (default: difference)")
#define DRAWING_OPTION_ROWS(ROW)                                                                                       \
    ROW(PAGE, "page", 0, "a4|a3", "d", "paper: a4 upright or a3 across (default: a3)")                                 \
    ROW(HIDDEN, "hidden", 0, "true|false", "d", "hidden lines in dashes (default: true)")                              \
    ROW(DATE, "date", 0, "TEXT", "d", "date in the title block (default: none)")
#define GENERAL_OPTION_ROWS(ROW)                                                                                       \
    ROW(TYPE, "type", 0, "TYPE", DRAWING_COMMANDS "d",                                                                     \
        "format of FILE:" OPTIONS_TYPES " (default: by its ending, else by its bytes)")                                \
    ROW(PART, "part", 0, "NAME=FILE", DRAWING_COMMANDS "d",                                                                \
        "file for {\"asset\": \"NAME\"} in a scene instead of the one beside it; repeatable")                          \
    ROW(ROOT, "root", 0, "DIR", DRAWING_COMMANDS "mcd",                                                                 \
        "folder of the files that FILE may refer to: models, textures (default: its own); mcp: of all files that it "  \
        "may read")                                                                                                    \
    ROW(SERVER, "server", 0, "URL", DRAWING_COMMANDS,                                                                  \
        "daemon that draws instead of this process (default: $ZRASTER_SERVER, else none)")                             \
    ROW(TOKEN_FILE, "token-file", 0, "FILE", DRAWING_COMMANDS,                                                         \
        "file whose first line is the server's token (default: $ZRASTER_TOKEN)")                                       \
    ROW(THREADS, "threads", 'j', "N", DRAWING_COMMANDS "mcd", "number of threads (default: all processors)")            \
    ROW(MEMORY, "memory", 0, "SIZE|N%", DRAWING_COMMANDS "mcd",                                                         \
        "memory for scenes and their pictures, such as 8G or 50% of what the system can spare (default: 75%, at "      \
        "least 1G)")                                                                                                   \
    ROW(MAX_FILE_BYTES, "max-file-bytes", 0, "N", DRAWING_COMMANDS "cd", "largest input that is read (default: 8 GiB)") \
    ROW(QUIET, "quiet", 'q', NULL, DRAWING_COMMANDS "cd", "no warnings")                                                \
    ROW(VERBOSE, "verbose", 'v', NULL, DRAWING_COMMANDS, "line per output: name, size, look and times")                \
    ROW(PLAIN, "plain", 0, NULL, "rbwvst", "no progress on a terminal (also with the variable NO_COLOR)")              \
    ROW(HELP, "help", 'h', NULL, "ribcdwlhvstm", "help of the command")                                                 \
    ROW(VERSION, "version", 'V', NULL, "ribcdwlhvstm", "version of zraster")
#define OPTION_ROWS(ROW) OUTPUT_OPTION_ROWS(ROW) DRAWING_OPTION_ROWS(ROW) GENERAL_OPTION_ROWS(ROW)

/* ROW(parameter, short letter) */
#define LETTER_ROWS(ROW)                                                                                               \
    ROW(channel, 'c')                                                                                                  \
    ROW(width, 'W')                                                                                                    \
    ROW(height, 'H')

#endif
