/* Stands in for Open Image Denoise: gives back colour + 10 albedo + 100 direction, and counts what it is
   asked for. Pictures one pixel wide are refused. */
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct filter { float *color, *albedo, *normal, *output; size_t width, height; bool hdr, clean, committed; };
static int devices, filters;
static char error[64];

void *oidnNewDevice(int type) { return type == 1 ? (devices++, malloc(1)) : NULL; }
void oidnCommitDevice(void *device) { (void)device; }
void oidnReleaseDevice(void *device) { devices--; free(device); }
void *oidnNewFilter(void *device, const char *type) {
    (void)device;
    filters++;
    return strcmp(type, "RT") ? NULL : calloc(1, sizeof(struct filter));
}
void oidnReleaseFilter(void *filter) { filters--; free(filter); }
void oidnSetSharedFilterImage(void *f, const char *name, void *pixels, int format, size_t width, size_t height,
                              size_t offset, size_t pixel, size_t row) {
    struct filter *filter = f;
    if (format != 3 || offset || pixel || row) snprintf(error, sizeof error, "format of %s", name);
    filter->width = width;
    filter->height = height;
    if (!strcmp(name, "color")) filter->color = pixels;
    if (!strcmp(name, "albedo")) filter->albedo = pixels;
    if (!strcmp(name, "normal")) filter->normal = pixels;
    if (!strcmp(name, "output")) filter->output = pixels;
}
void SET_BOOL(void *f, const char *name, bool value) {
    struct filter *filter = f;
    if (!strcmp(name, "hdr")) filter->hdr = value;
    if (!strcmp(name, "cleanAux")) filter->clean = value;
}
void oidnCommitFilter(void *f) { ((struct filter *)f)->committed = true; }
void oidnExecuteFilter(void *f) {
    struct filter *filter = f;
    if (!filter->committed || !filter->hdr || !filter->clean) snprintf(error, sizeof error, "not committed");
    if (filter->width == 1) { snprintf(error, sizeof error, "too narrow"); return; }
    for (size_t i = 0; i < 3 * filter->width * filter->height; i++)
        filter->output[i] = filter->color[i] + 10 * filter->albedo[i] + 100 * filter->normal[i];
}
int oidnGetDeviceError(void *device, const char **message) {
    static char told[64];
    (void)device;
    strcpy(told, error);
    error[0] = 0;
    if (devices != 1 || filters > 1) strcpy(told, "something was not released");
    *message = told;
    return told[0] ? 1 : 0;
}
