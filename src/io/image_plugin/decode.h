#pragma once

#include <stddef.h>
#include <stdint.h>

#include "io/image_plugin/image_plugin.h"

/* The part of the plugin's C interface that reads pictures. */

#ifdef __cplusplus
extern "C" {
#endif

/* A file of any format that OpenImageIO reads, and how many pixels it may have. */
typedef struct {
  const char* bytes;
  size_t size;
  int64_t max_pixels;
} LascauxEncoded;

/* Gives memory for an 8-bit sRGB picture with straight alpha, 4 bytes a pixel, rows from the top.
   It is called once, before a success. */
typedef uint8_t* (*LascauxCanvas)(void* context, int32_t width, int32_t height);

/* Decodes the first picture of the file, turned upright. Returns 0, or 1 with the reason given to
   `reason`, or 2 with the size in its place when there are too many pixels. */
typedef int32_t (*LascauxDecode)(const LascauxEncoded* file, LascauxCanvas canvas,
                                 LascauxImageSink reason, void* context);

#define LASCAUX_DECODE "lascaux_decode_1"

#ifdef __cplusplus
}
#endif
