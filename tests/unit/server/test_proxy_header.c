/* PROXY headers of both versions, whole and in pieces. */
#include <string.h>

#include "http/proxy_header.h"
#include "support/tests.h"

#define SIGN "\r\n\r\n\0\r\nQUIT\n"

/* Takes bytes in pieces of `step`, and returns the count of those taken. */
static size_t take(struct proxy_header *header, const char *bytes, size_t size, size_t step)
{
    size_t taken = 0;
    *header = (struct proxy_header){0};
    while (taken < size) {
        const size_t piece = size - taken < step ? size - taken : step;
        const size_t more = proxy_header_take(header, bytes + taken, piece);
        taken += more;
        if (more < piece) break;
    }
    return taken;
}

/* `source`: "" for none. */
static void assert_source(const char *bytes, size_t size, const char *source)
{
    char rest[1024];
    struct proxy_header header;
    memcpy(rest, bytes, size);
    memcpy(rest + size, "GET / HTTP/1.1", 14);
    for (size_t step = 1; step <= size + 14; step++) {
        char found[IP_TEXT_SIZE] = "";
        assert_int_equal(take(&header, rest, size + 14, step), size);
        assert_null(header.wrong);
        assert_true(header.is_whole);
        if (header.has_source) ip_print(&header.source, found);
        assert_string_equal(found, source);
    }
    for (size_t part = 0; part < size; part++) {
        take(&header, bytes, part, 7);
        assert_null(header.wrong);
        assert_false(header.is_whole);
    }
}

static void assert_wrong(const char *bytes, size_t size, const char *detail)
{
    struct proxy_header header;
    for (size_t step = 1; step <= size; step++) {
        take(&header, bytes, size, step);
        assert_false(header.is_whole);
        assert_non_null(header.wrong);
        if (!strstr(header.wrong, detail)) fail_msg("'%s' instead of '%s'", header.wrong, detail);
    }
}

#define SOURCE(text, source) assert_source(text, sizeof(text) - 1, source)
#define WRONG(text, detail)  assert_wrong(text, sizeof(text) - 1, detail)

TEST(version_1_names_its_client)
{
    SOURCE("PROXY TCP4 192.0.2.1 10.0.0.1 56324 443\r\n", "192.0.2.1");
    SOURCE("PROXY TCP4 255.255.255.255 255.255.255.255 65535 65535\r\n", "255.255.255.255");
    SOURCE("PROXY TCP6 2001:db8::1 ::1 0 0\r\n", "2001:db8::1");
    SOURCE("PROXY TCP6 ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff 65535 65535\r\n",
           "ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff");
    SOURCE("PROXY UNKNOWN\r\n", "");
    SOURCE("PROXY UNKNOWN ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff 65535 "
           "65535\r\n",
           "");
}

TEST(faults_of_version_1_are_refused)
{
    WRONG("GET / HTTP/1.1\r\n", "without a PROXY header");
    WRONG("PROXX TCP4 192.0.2.1 10.0.0.1 1 2\r\n", "without a PROXY header");
    WRONG("proxy TCP4 192.0.2.1 10.0.0.1 1 2\r\n", "without a PROXY header");
    WRONG("\x16\x03\x01", "without a PROXY header");
    WRONG("PROXY TCP4 192.0.2.1 10.0.0.1 1 2\n", "LF alone");
    WRONG("PROXY \n", "LF alone");
    WRONG("PROXY \r\n", "malformed");
    WRONG("PROXY TCP4\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1 10.0.0.1 1\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1 10.0.0.1 1 2 3\r\n", "malformed");
    WRONG("PROXY TCP4  192.0.2.1 10.0.0.1 1 2\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1 10.0.0.1 1 65536\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1 10.0.0.1 -1 2\r\n", "malformed");
    WRONG("PROXY TCP4 2001:db8::1 ::1 1 2\r\n", "malformed");
    WRONG("PROXY TCP6 192.0.2.1 10.0.0.1 1 2\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1\0 10.0.0.1 1 2\r\n", "malformed");
    WRONG("PROXY TCP4 192.0.2.1%1b[31m 10.0.0.1 1 2\r\n", "malformed");
    WRONG("PROXY UDP4 192.0.2.1 10.0.0.1 1 2\r\n", "malformed");
    char endless[2 * PROXY_HEADER_V1_MAX] = "PROXY UNKNOWN ";
    memset(endless + 14, 'a', sizeof endless - 14);
    assert_wrong(endless, sizeof endless, "longer than 107 bytes");
}

TEST(version_2_names_its_client)
{
    SOURCE(SIGN "\x21\x11\x00\x0c\xc0\x00\x02\x01\x0a\x00\x00\x01\xdc\x04\x01\xbb", "192.0.2.1");
    SOURCE(SIGN
           "\x21\x21\x00\x24\x20\x01\x0d\xb8\0\0\0\0\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x02",
           "2001:db8::1");
    /* With a CRC, a unique id and padding behind the addresses. */
    SOURCE(SIGN "\x21\x11\x00\x1b\xc0\x00\x02\x01\x0a\x00\x00\x01\xdc\x04\x01\xbb\x03\x00\x04\x01\x02\x03\x04\x05\x00"
                "\x02\r\n\x04\x00\x00",
           "192.0.2.1");
    SOURCE(SIGN "\x20\x00\x00\x00", ""); /* LOCAL */
    SOURCE(SIGN "\x20\x11\x00\x0c\xc0\x00\x02\x01\x0a\x00\x00\x01\xdc\x04\x01\xbb", "");
    SOURCE(SIGN "\x20\xff\x00\x03\x01\x02\x03", "");
    SOURCE(SIGN "\x21\x00\x00\x00", "");         /* UNSPEC */
    SOURCE(SIGN "\x21\x00\x00\x02\xff\xff", ""); /* UNSPEC with what is to be skipped */
    char local[16 + 216] = SIGN "\x21\x31\x00\xd8/run/client";
    assert_source(local, sizeof local, ""); /* AF_UNIX */
}

TEST(faults_of_version_2_are_refused)
{
    WRONG("\r\n\r\n\0\r\nQUIX\n\x21\x11", "without a PROXY header");
    WRONG("\r\n\r\nGET", "without a PROXY header");
    WRONG(SIGN "\x11\x11\x00\x0c", "version");
    WRONG(SIGN "\x31\x11\x00\x0c", "version");
    WRONG(SIGN "\x22\x11\x00\x0c", "command");
    WRONG(SIGN "\x21\x41\x00\x0c", "kind of address");
    WRONG(SIGN "\x21\x13\x00\x0c", "kind of address");
    WRONG(SIGN "\x21\x11\x00\x0b", "shorter than its addresses");
    WRONG(SIGN "\x21\x21\x00\x23", "shorter than its addresses");
    WRONG(SIGN "\x21\x31\x00\xd7", "shorter than its addresses");
    WRONG(SIGN "\x21\x11\xff\xff", "longer than 4096 bytes");
}

TEST(random_headers_end)
{
    struct proxy_header header;
    unsigned seed = 7;
    for (int round = 0; round < 100000; round++) {
        char bytes[300] = SIGN "\x21\x11\x00\x0c";
        for (size_t i = round % 2 ? 12 : 0; i < sizeof bytes; i++)
            if (((seed = seed * 1103515245 + 12345) >> 16) % 3 == 0) bytes[i] = (char)(seed >> 24);
        const size_t taken = take(&header, bytes, sizeof bytes, 1 + (size_t)round % 17);
        assert_false(header.is_whole && header.wrong);
        assert_true(header.is_whole || header.wrong || taken == sizeof bytes);
    }
}

RUN_TESTS(NULL, NULL)
