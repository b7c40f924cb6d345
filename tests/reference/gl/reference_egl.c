/* The reference through EGL without a surface, as every Mesa has it. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/gl/reference.h"

struct egl {
    EGLDisplay display;
    EGLContext context;
};

static void close_context(void *context)
{
    struct egl *egl = context;
    if (!egl) return;
    if (egl->display != EGL_NO_DISPLAY) {
        eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (egl->context != EGL_NO_CONTEXT) eglDestroyContext(egl->display, egl->context);
        eglTerminate(egl->display);
    }
    free(egl);
}

/* NULL, or the step that failed. */
static const char *open_steps(struct egl *egl)
{
    EGLint major, minor;
    egl->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (egl->display == EGL_NO_DISPLAY) return "eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA)";
    if (!eglInitialize(egl->display, &major, &minor)) return "eglInitialize";
    if (!eglBindAPI(EGL_OPENGL_API)) return "eglBindAPI(EGL_OPENGL_API)";
    /* EGL_KHR_no_config_context: frame buffer objects bring their own formats. */
    egl->context = eglCreateContext(egl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, NULL);
    if (egl->context == EGL_NO_CONTEXT) return "eglCreateContext";
    /* EGL_KHR_surfaceless_context. */
    if (!eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context)) return "eglMakeCurrent";
    return NULL;
}

struct names {
    int count;
    char *list[256];
};

static int add_name(struct dl_phdr_info *info, size_t size, void *argument)
{
    struct names *names = argument;
    (void)size;
    if (names->count < 256) names->list[names->count++] = strdup(info->dlpi_name);
    return 0;
}

/* EGL unloads its driver at the end, before a leak checker looks: what the driver keeps for good could not
 * be told from a leak of ours. So every library stays. */
static void keep_libraries(void)
{
    struct names names = {.count = 0};
    dl_iterate_phdr(add_name, &names);
    for (int i = 0; i < names.count; i++) {
        if (names.list[i] && names.list[i][0]) dlopen(names.list[i], RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        free(names.list[i]);
    }
}

static void *open_context(struct reference_error *error)
{
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1); /* the machine's graphics card is not asked */
    struct egl *egl = calloc(1, sizeof *egl);
    const char *step = egl ? open_steps(egl) : "no memory";
    keep_libraries();
    if (!step) return egl;
    snprintf(error->text, sizeof error->text, "EGL: %s failed (EGL error 0x%04x)", step, (unsigned)eglGetError());
    close_context(egl);
    return NULL;
}

const struct reference_context reference_context = {"EGL", open_context, close_context};
