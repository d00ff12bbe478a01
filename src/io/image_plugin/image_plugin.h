#pragma once

#include <stddef.h>
#include <stdint.h>

/* The C interface between the library and the plugin that holds OpenImageIO: plain types, so that
   both may be built with different compilers. A change of meaning gets a new name. */

#ifdef __cplusplus
extern "C" {
#endif

/* Takes the encoded bytes, in one or more pieces. */
typedef void (*LascauxImageSink)(void* context, const char* bytes, size_t size);

/* Linear floats: `channels` values a pixel, named as in an OpenEXR file; rows from the top. */
typedef struct {
  int32_t width, height, channels;
  const char* const* names;
  const float* pixels;
} LascauxLayers;

/* Encodes as OpenEXR. Returns 0, or 1 with the reason given to the sink in place of the picture. */
typedef int32_t (*LascauxEncodeExr)(const LascauxLayers* layers, LascauxImageSink sink,
                                    void* context);

#define LASCAUX_ENCODE_EXR "lascaux_encode_exr_1"

#ifdef __cplusplus
}
#endif
