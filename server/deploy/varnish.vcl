# Two replicas of zrasterd behind Varnish 7. Check: varnishd -C -f varnish.vcl. Run: varnishd -a :80 -f varnish.vcl -s
# malloc,1g -s Transient=malloc,512m; bodies and answers that are not kept take Transient.
vcl 4.1;

import directors;
import std;

probe ready {
    .url = "/readyz";
    .interval = 500ms;
    .timeout = 1s;
    .window = 3;
    .threshold = 2;
    .initial = 2;
}

backend zraster_1 {
    .host = "127.0.0.1";
    .port = "8081";
    .probe = ready;
    .connect_timeout = 1s;
    .first_byte_timeout = 60s;      # above --render-timeout-ms and the wait before it
    .between_bytes_timeout = 60s;
}

backend zraster_2 {
    .host = "127.0.0.1";
    .port = "8082";
    .probe = ready;
    .connect_timeout = 1s;
    .first_byte_timeout = 60s;
    .between_bytes_timeout = 60s;
}

sub vcl_init {
    new zraster = directors.round_robin();
    zraster.add_backend(zraster_1);
    zraster.add_backend(zraster_2);
}

sub vcl_recv {
    set req.backend_hint = zraster.backend();
    # Prometheus asks the replicas themselves.
    if (req.url ~ "^/metrics(\?|$)") {
        return (synth(404));
    }
    unset req.http.Cookie;
    unset req.http.Forwarded;
    set req.http.X-Forwarded-For = client.ip;
    if (req.method == "GET" || req.method == "HEAD") {
        return (hash);
    }
    # The body is kept, so that it can be sent again: --body-max-bytes. A render is a pure function of the request, an asset has
    # its hash as its name.
    if (req.method == "POST" || req.method == "PUT") {
        if (std.integer(req.http.Content-Length, 0) > 67108864 || !std.cache_req_body(64MB)) {
            return (synth(413));
        }
    }
    return (pass);
}

# Who may not ask gets no kept answer of others.
sub vcl_hash {
    hash_data(req.http.Authorization);
}

sub turn_to_other {
    if (beresp.backend == zraster_1) {
        set bereq.backend = zraster_2;
    } else {
        set bereq.backend = zraster_1;
    }
}

sub vcl_backend_response {
    # The other replica may be free. The last 503 is passed on with its Retry-After.
    if (beresp.status == 503 && bereq.retries < 2) {
        call turn_to_other;
        return (retry);
    }
    # Parts go on one by one. Other answers go on once they are whole: until then, another replica can take over.
    set beresp.do_stream = beresp.http.Content-Type ~ "^multipart/";
    if (beresp.status >= 400 || beresp.http.Cache-Control !~ "public|max-age|no-cache" || beresp.http.Cache-Control ~ "no-store|private") {
        # For two minutes, requests for such an answer do not wait for one another.
        set beresp.uncacheable = true;
        set beresp.ttl = 120s;
        return (deliver);
    }
    # An answer past its time is revalidated by its ETag: at once for no-cache, else after the grace, in which it is served while
    # the new one is fetched or no replica is there.
    if (beresp.http.ETag) {
        set beresp.keep = 7d;
    }
    if (beresp.http.Cache-Control ~ "no-cache") {
        set beresp.ttl = 1ms;
        set beresp.grace = 0s;
        return (deliver);
    }
    # A signed address with an end is not served beyond it.
    if (beresp.http.Cache-Control ~ "must-revalidate") {
        set beresp.grace = 0s;
        return (deliver);
    }
    set beresp.grace = 1h;
}

sub vcl_backend_error {
    if (bereq.retries < 4) {
        call turn_to_other;
        return (retry);
    }
}

sub vcl_deliver {
    if (obj.hits > 0) {
        set resp.http.X-Cache = "HIT";
    } else {
        set resp.http.X-Cache = "MISS";
    }
}
