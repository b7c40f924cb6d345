/* The reference through EGL without a surface, as every Mesa has it. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>
#include <stdlib.h>

#include "reference/reference.h"

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

static void *open_context(struct reference_error *error)
{
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1); /* the machine's graphics card is not asked */
    struct egl *egl = calloc(1, sizeof *egl);
    const char *step = egl ? open_steps(egl) : "no memory";
    if (!step) return egl;
    snprintf(error->text, sizeof error->text, "EGL: %s failed (EGL error 0x%04x)", step, (unsigned)eglGetError());
    close_context(egl);
    return NULL;
}

const struct reference_context reference_context = {"EGL", open_context, close_context};
