/* curl_rows.h - client: functions and numbers of libcurl. Only --server loads it: loading takes time, and drawing in this
 * process needs no network.
 *
 * The build needs no header of libcurl. The binary interface of libcurl.so.4 is stable; test_curl_rows.c includes curl.h
 * first, so that the compiler and the test compare these declarations with it. */
#ifndef CURL_ROWS_H
#define CURL_ROWS_H

#include <stddef.h>
#include <stdint.h>

#define CURL_NUMBERS(ROW)                                                                                              \
    ROW(CURL_GLOBAL_DEFAULT, 3)                                                                                        \
    ROW(CURL_ERROR_SIZE, 256)                                                                                          \
    ROW(CURLE_OK, 0)                                                                                                   \
    ROW(CURLE_FAILED_INIT, 2)                                                                                          \
    ROW(CURLE_COULDNT_RESOLVE_HOST, 6)                                                                                 \
    ROW(CURLE_COULDNT_CONNECT, 7)                                                                                      \
    ROW(CURLE_OUT_OF_MEMORY, 27)                                                                                       \
    ROW(CURLOPT_WRITEDATA, 10001)                                                                                      \
    ROW(CURLOPT_ERRORBUFFER, 10010)                                                                                    \
    ROW(CURLOPT_TIMEOUT, 13)                                                                                           \
    ROW(CURLOPT_POSTFIELDS, 10015)                                                                                     \
    ROW(CURLOPT_USERAGENT, 10018)                                                                                      \
    ROW(CURLOPT_HTTPHEADER, 10023)                                                                                     \
    ROW(CURLOPT_HEADERDATA, 10029)                                                                                     \
    ROW(CURLOPT_NOPROGRESS, 43)                                                                                        \
    ROW(CURLOPT_CONNECTTIMEOUT, 78)                                                                                    \
    ROW(CURLOPT_NOSIGNAL, 99)                                                                                          \
    ROW(CURLOPT_MIMEPOST, 10269)                                                                                       \
    ROW(CURLOPT_CURLU, 10282)                                                                                          \
    ROW(CURLOPT_PROTOCOLS_STR, 10318)                                                                                  \
    ROW(CURLOPT_WRITEFUNCTION, 20011)                                                                                  \
    ROW(CURLOPT_HEADERFUNCTION, 20079)                                                                                 \
    ROW(CURLOPT_XFERINFOFUNCTION, 20219)                                                                               \
    ROW(CURLOPT_POSTFIELDSIZE_LARGE, 30120)                                                                            \
    ROW(CURLINFO_CONTENT_TYPE, 0x100012)                                                                               \
    ROW(CURLINFO_RESPONSE_CODE, 0x200002)                                                                              \
    ROW(CURLINFO_RETRY_AFTER, 0x600039)                                                                                \
    ROW(CURLUE_OK, 0)                                                                                                  \
    ROW(CURLUPART_URL, 0)                                                                                              \
    ROW(CURLUPART_PATH, 7)                                                                                             \
    ROW(CURLUPART_QUERY, 8)                                                                                            \
    ROW(CURLUPART_FRAGMENT, 9)

#ifndef CURLINC_CURL_H /* which curl.h defines */
enum {
#define CURL_NUMBER(name, value) name = (value),
    CURL_NUMBERS(CURL_NUMBER)
#undef CURL_NUMBER
};
typedef int CURLcode, CURLUcode, CURLUPart, CURLoption, CURLINFO;
typedef int64_t curl_off_t;
typedef void CURL;
typedef struct Curl_URL CURLU;
typedef struct curl_mime curl_mime;
typedef struct curl_mimepart curl_mimepart;
CURLUcode curl_url_get(const CURLU *url, CURLUPart part, char **text, unsigned flags); /* const in newer versions */
#endif
struct curl_slist;

CURLcode curl_global_init(long flags);
void curl_global_cleanup(void);
void curl_free(void *text);
CURL *curl_easy_init(void);
CURLcode curl_easy_setopt(CURL *handle, CURLoption option, ...);
CURLcode curl_easy_perform(CURL *handle);
CURLcode curl_easy_getinfo(CURL *handle, CURLINFO info, ...);
const char *curl_easy_strerror(CURLcode code);
void curl_easy_cleanup(CURL *handle);
struct curl_slist *curl_slist_append(struct curl_slist *list, const char *text);
void curl_slist_free_all(struct curl_slist *list);
CURLU *curl_url(void);
CURLUcode curl_url_set(CURLU *url, CURLUPart part, const char *text, unsigned flags);
void curl_url_cleanup(CURLU *url);
curl_mime *curl_mime_init(CURL *handle);
curl_mimepart *curl_mime_addpart(curl_mime *form);
CURLcode curl_mime_name(curl_mimepart *part, const char *name);
CURLcode curl_mime_data(curl_mimepart *part, const char *data, size_t size);
CURLcode curl_mime_type(curl_mimepart *part, const char *type);
CURLcode curl_mime_headers(curl_mimepart *part, struct curl_slist *headers, int takes_ownership);
void curl_mime_free(curl_mime *form);

#define CURL_ROWS(ROW)                                                                                                 \
    ROW(global_init)                                                                                                   \
    ROW(global_cleanup)                                                                                                \
    ROW(free)                                                                                                          \
    ROW(easy_init)                                                                                                     \
    ROW(easy_setopt)                                                                                                   \
    ROW(easy_perform)                                                                                                  \
    ROW(easy_getinfo)                                                                                                  \
    ROW(easy_strerror)                                                                                                 \
    ROW(easy_cleanup)                                                                                                  \
    ROW(slist_append)                                                                                                  \
    ROW(slist_free_all)                                                                                                \
    ROW(url)                                                                                                           \
    ROW(url_get)                                                                                                       \
    ROW(url_set)                                                                                                       \
    ROW(url_cleanup)                                                                                                   \
    ROW(mime_init)                                                                                                     \
    ROW(mime_addpart)                                                                                                  \
    ROW(mime_name)                                                                                                     \
    ROW(mime_data)                                                                                                     \
    ROW(mime_type)                                                                                                     \
    ROW(mime_headers)                                                                                                  \
    ROW(mime_free)

struct curl_functions {
#define CURL_MEMBER(name) __typeof__(curl_##name) *name;
    CURL_ROWS(CURL_MEMBER)
#undef CURL_MEMBER
};

#endif
