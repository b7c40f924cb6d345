/* http_room.h - room for answers that wait for their readers: answer_memory_bytes and max_streams, and the shares of a
 * client. Any thread may call, but for http_room_leave. For http*.c only.
 *
 * Shares: large answers and streams leave a part of answer_memory_bytes to small answers. A client leaves half of it,
 * and half of max_streams, to others. So slow readers of one address cost only themselves, and those of many addresses
 * cost no small answer.
 */
#ifndef ZRASTERD_HTTP_ROOM_H
#define ZRASTERD_HTTP_ROOM_H

#include "http_state.h"

/* Returns true if answer_memory_bytes are taken. */
bool http_room_is_full(struct http *http);

/* Returns true if `more` bytes would take the part of the small answers. */
bool http_room_is_small(struct http *http, size_t more);

/* Returns true if a client has more than its share; `client` may be NULL. */
bool http_room_is_taken_by(const struct http *http, struct client *client);

/* Returns true if three quarters of answer_memory_bytes or of max_streams are taken: slow readers are then cut off
 * early, so that others need not wait. */
bool http_room_is_short(struct http *http);

/* Counts bytes of an exchange that wait for its reader, and counts them no more. */
void http_room_take(struct exchange *exchange, size_t bytes);
void http_room_return(struct exchange *exchange, size_t bytes);

/* Counts the bytes of a stream that begins to wait, or returns why there is no room for them. */
enum refusal http_room_take_stream(struct exchange *exchange, size_t bytes);

/* Counts a stream, unless it has no place, and counts it no more. */
enum refusal http_room_open_stream(struct exchange *exchange);
void http_room_close_stream(struct exchange *exchange);

/* Returns all that the exchange has, and leaves its client. On the thread of the loop. */
void http_room_leave(struct exchange *exchange);

#endif
