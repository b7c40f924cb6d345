/* settings.c - the table of all settings: a member of struct config and a row here are all that a setting needs. */
#include "settings.h"

#include <ctype.h>
#include <string.h>

#define MIB      ((uint64_t)1 << 20)
#define GIB      ((uint64_t)1 << 30)
#define DAY_MS   ((uint64_t)86400000)
#define AT(name) offsetof(struct config, name)

/* Side and coordinates cannot be raised: the rasterizer's fixed point is proven up to these bounds. */
static const struct setting ROWS[] = {
    {"config", TEXT, AT(config), false, 0, 0, 0, "", "",
     "file of settings: lines KEY = VALUE, whose keys are the names of these flags; empty: none"},
    {"address", ADDRESS, AT(address), false, 0, 0, 0, "127.0.0.1", "", "numeric IPv4 or IPv6 address to listen on"},
    {"port", NUMBER, AT(port), false, 8080, 0, 65535, NULL, "", "port to listen on; 0: any free port"},
    {"token", SECRET, AT(token), false, 0, 0, 0, "", "",
     "bearer token that clients must send; empty: none; prefer its variable, which ps does not show"},
    {"token-file", TEXT, AT(token_file), false, 0, 0, 0, "", "",
     "file of further tokens, one per line; SIGHUP reads it anew"},
    {"keys-file", TEXT, AT(keys_file), false, 0, 0, 0, "", "",
     "file of keys, one per line in hexadecimal digits, for signatures of addresses below /v1/renders/; SIGHUP reads "
     "it anew"},
    {"presets", TEXT, AT(presets), false, 0, 0, 0, "", "",
     "file of presets for /v1/renders/, one per line, such as small = look=studio&width=320; SIGHUP reads it anew"},
    {"only-presets", SWITCH, AT(only_presets), false, 0, 0, 0, "off", "",
     "on or off: addresses below /v1/renders/ take a preset and no parameters of their own"},
    {"metrics", SWITCH, AT(metrics), false, 0, 0, 0, "on", "", "on or off: /metrics for Prometheus, without a token"},
    {"page", SWITCH, AT(page), false, 0, 0, 0, "on", "",
     "on or off: the page at / for browsers and the manual at /docs/"},
    {"engine-dir", TEXT, AT(engine_dir), false, 0, 0, 0, "", "",
     "folder of the package for JavaScript (make npm), read at the start: with it, the page itself draws while a model "
     "turns; empty: none"},
    {"allow-origin", ORIGINS, AT(allow_origin), false, 0, 0, 0, "", "",
     "origins whose web pages may use the daemon (CORS), such as https://example.org, with spaces or commas between "
     "them; *: all; empty: only its own page"},
    {"trusted-proxies", NETWORKS, AT(trusted_proxies), false, 0, 0, 0, "", "",
     "addresses and networks of proxies that name their clients, such as 10.0.0.1 or 10.0.0.0/8, loopback, private, "
     "with spaces or commas between them; empty: none"},
    {"client-header", CLIENT_HEADER, AT(client_header), false, 0, 0, 0, "x-forwarded-for", "",
     "header that trusted proxies append the client's address to: x-forwarded-for, forwarded (RFC 7239), or none"},
    {"proxy-protocol", SWITCH, AT(proxy_protocol), false, 0, 0, 0, "off", "",
     "on or off: connections of trusted proxies begin with a PROXY header, version 1 or 2"},
    {"workers", NUMBER, AT(workers), true, 0, 0, 256, NULL, "",
     "requests processed at once, besides one small request; 0: one per core"},
    {"threads", NUMBER, AT(threads), true, 0, 0, ZR_TEAM_MAX, NULL, "",
     "render threads, shared by all requests; 0: one per core"},
    {"isa", ISA, AT(isa), false, 0, 0, 0, "auto", "",
     "instruction set of the renderer: scalar, sse2, avx2, avx512, neon, or auto, the widest of the machine; "
     "pixels do not depend on it"},
    {"queue", NUMBER, AT(queue), true, 0, 0, 65536, NULL, "requests",
     "that may wait in each queue, small and large; beyond 2 per worker, only those that should start within a second; "
     "0: 256 per worker"},
    {"max-per-client", NUMBER, AT(max_per_client), true, 4, 0, 65536, NULL, "requests",
     "in flight per public address (IPv6: per network of 64 bits); 0: no limit; behind a proxy, see --trusted-proxies"},
    {"max-per-private-client", NUMBER, AT(max_per_private_client), true, 0, 0, 65536, NULL, "requests",
     "in flight per address of this machine or of a private network; 0: no limit"},
    {"max-connections", NUMBER, AT(max_connections), true, 1024, 8, 65536, NULL, "", "open connections"},
    {"max-streams", NUMBER, AT(max_streams), true, 16, 1, 256, NULL, "answers",
     "streamed at once; each has a thread, which waits while its reader is slow"},
    {"body-max-bytes", NUMBER, AT(body_max_bytes), true, 64 * MIB, 1, 4 * GIB, NULL, "bytes", "of one request body"},
    {"upload-memory-bytes", NUMBER, AT(upload_memory_bytes), true, 512 * MIB, 1, 1024 * GIB, NULL, "bytes",
     "of all request bodies held at once; their pages may take up to twice that"},
    {"request-memory-bytes", NUMBER, AT(request_memory_bytes), true, GIB, MIB, 1024 * GIB, NULL, "bytes",
     "that one render may allocate"},
    {"keep-memory-bytes", NUMBER, AT(keep_memory_bytes), true, 256 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "that a worker may keep between requests; they return to the system after 2 s without a request"},
    {"keep-image-bytes", NUMBER, AT(keep_image_bytes), true, 128 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of decoded texture images kept between requests, in blocks of 4096; the least recently used are dropped first, "
     "and all if memory is short; 0: none"},
    {"keep-text-bytes", NUMBER, AT(keep_text_bytes), true, 128 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of data: URIs of glTF kept from the second time on, as text and decoded, in blocks of 4096; the least recently "
     "used are dropped first, and all if memory is short; 0: none"},
    {"keep-mesh-bytes", NUMBER, AT(keep_mesh_bytes), true, 256 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of model files kept as read from the second time on, with copies of those that were not stored, in blocks of "
     "4096; the least recently used are dropped first, and all if memory is short; 0: none"},
    {"keep-answer-bytes", NUMBER, AT(keep_answer_bytes), true, 0, 0, 1024 * GIB, NULL, "bytes",
     "of answers of addresses kept under their ETags, in blocks of 4096; the least recently used are dropped first, "
     "and all if memory is short; 0: none"},
    {"answer-memory-bytes", NUMBER, AT(answer_memory_bytes), true, 512 * MIB, 1, 1024 * GIB, NULL, "bytes",
     "of all answers that wait for their readers, and of streams that do; beyond it, no render begins"},
    {"cgroup", TEXT, AT(cgroup), false, 0, 0, 0, "/sys/fs/cgroup", "",
     "folder of the control group; requests get 503 beyond 92 % of its memory limit"},
    {"assets-dir", FOLDER, AT(assets_dir), false, 0, 0, 0, "", "",
     "existing directory for uploaded assets, stored under their hash; empty: no assets"},
    {"assets-max-bytes", NUMBER, AT(assets_max_bytes), true, GIB, 4096, 1024 * 1024 * GIB, NULL, "bytes",
     "of all assets together, in blocks of 4096; the least recently used are removed first"},
    {"header-timeout-ms", NUMBER, AT(header_timeout_ms), true, 10000, 1, DAY_MS, NULL, "ms",
     "for a complete request header to arrive"},
    {"idle-timeout-ms", NUMBER, AT(idle_timeout_ms), true, 60000, 1, DAY_MS, NULL, "ms",
     "that a kept connection may stay silent"},
    {"body-timeout-ms", NUMBER, AT(body_timeout_ms), true, 30000, 1, DAY_MS, NULL, "ms",
     "for a complete request body to arrive"},
    {"body-min-bytes-per-second", NUMBER, AT(body_min_bytes_per_second), true, 1024, 0, GIB, NULL, "bytes/s",
     "that a body must average after its first 5 s; 0: no limit"},
    {"answer-min-bytes-per-second", NUMBER, AT(answer_min_bytes_per_second), true, 1024, 0, GIB, NULL, "bytes/s",
     "at which a client must read its answer; 0: no limit"},
    {"write-timeout-ms", NUMBER, AT(write_timeout_ms), true, 60000, 1, DAY_MS, NULL, "ms",
     "for a client to read its complete answer"},
    {"render-timeout-ms", NUMBER, AT(render_timeout_ms), true, 10000, 1, DAY_MS, NULL, "ms",
     "that a worker may spend on one request"},
    {"cost-max-ms", NUMBER, AT(cost_max_ms), true, 20000, 1, DAY_MS, NULL, "ms",
     "of predicted processor time of one request"},
    {"drain-delay-ms", NUMBER, AT(drain_delay_ms), true, 0, 0, DAY_MS, NULL, "ms",
     "after SIGTERM during which /readyz is 503 and requests are still served, for load balancers to notice"},
    {"drain-timeout-ms", NUMBER, AT(drain_timeout_ms), true, 30000, 0, DAY_MS, NULL, "ms",
     "for requests in flight to end after SIGTERM and drain-delay-ms"},
    {"json-depth-max", NUMBER, AT(json_depth_max), true, 0, 1, 512, NULL, "", "nesting of arrays and objects"},
    {"window-side-max", NUMBER, AT(window_side_max), true, 0, 1, 8192, NULL, "pixels", "per side of an image"},
    {"window-pixels-max", NUMBER, AT(window_pixels_max), true, 0, 1, GIB, NULL, "pixels",
     "of all outputs of a request together"},
    {"polygon-vertices-max", NUMBER, AT(polygon_vertices_max), true, 0, 3, 8192, NULL, "", "vertices of one polygon"},
    {"instances-max", NUMBER, AT(instances_max), true, 0, 1, 1u << 24, NULL, "", "meshes placed by nodes"},
    {"image-pixels-max", NUMBER, AT(image_pixels_max), true, 0, 1, GIB, NULL, "pixels",
     "of all images of a scene's textures together"},
    {"coordinate-max", NUMBER, AT(coordinate_max), true, 0, 1, 1000000, NULL, "", "magnitude of a coordinate"},
};

enum { COUNT = sizeof ROWS / sizeof ROWS[0] };
_Static_assert((int)COUNT <= (int)CONFIG_SETTINGS_MAX, "struct config has a source for each");

const struct setting *setting_at(size_t index)
{
    return index < COUNT ? &ROWS[index] : NULL;
}

const struct setting *setting_find(const char *name, size_t length)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++)
        if (strlen(s->flag) == length && memcmp(s->flag, name, length) == 0) return s;
    return NULL;
}

bool setting_is_file(const struct setting *setting)
{
    return setting->offset == AT(config);
}

struct config_source *setting_source(struct config *config, const struct setting *setting)
{
    return &config->sources[setting - ROWS];
}

void setting_variable(char name[SETTING_NAME_SIZE], const char *flag)
{
    size_t used = (size_t)snprintf(name, SETTING_NAME_SIZE, SETTING_VARIABLE);
    for (; *flag && used < SETTING_NAME_SIZE - 1; flag++)
        name[used++] = *flag == '-' ? '_' : (char)toupper((unsigned char)*flag);
    name[used] = '\0';
}
