/* curl_rows.h - client: functions of libcurl. Only --server loads it: loading takes time, and drawing in this process
 * needs no network. */
#ifndef CURL_ROWS_H
#define CURL_ROWS_H

#define CURL_DISABLE_TYPECHECK
#include <curl/curl.h>
#undef curl_easy_setopt
#undef curl_easy_getinfo

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
    ROW(mime_filename)                                                                                                 \
    ROW(mime_headers)                                                                                                  \
    ROW(mime_free)

struct curl_functions {
#define CURL_MEMBER(name) __typeof__(curl_##name) *name;
    CURL_ROWS(CURL_MEMBER)
#undef CURL_MEMBER
};

#endif
