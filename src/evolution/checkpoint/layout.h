/* The bytes of a checkpoint file, shared by its writer and its reader: little-endian. */
#ifndef FG__CHECKPOINT_LAYOUT_H
#define FG__CHECKPOINT_LAYOUT_H

#include <string.h>

#include "evolution/checkpoint/file.h"

/* Preamble, values, text, table. A program that changes line ends spoils the first bytes,
 * as those of PNG. */
#define FG__CHECKPOINT_MAGIC "\211FGC\r\n\032\n"

enum {
  FG__CHECKPOINT_FORMAT = 1,
  FG__PREAMBLE_BYTES = FG__CHECKPOINT_FIRST_OFFSET,
  FG__ENTRY_BYTES = 80,   /* of the table, one a record */
  FG__CHUNK_BYTES = 65536 /* of values at once */
};

/* Places in the preamble. */
enum {
  FG__AT_FORMAT = 8,
  FG__AT_FILE_BYTES = 16,
  FG__AT_TEXT_OFFSET = 24,
  FG__AT_TEXT_BYTES = 32,
  FG__AT_RECORD_COUNT = 40,
  FG__AT_TEXT_CHECKSUM = 48,
  FG__AT_TABLE_CHECKSUM = 52,
  FG__AT_PREAMBLE_CHECKSUM = 60
};

/* Places in an entry of the table, after the array's name. */
enum {
  FG__AT_GRID = 24,
  FG__AT_ELEMENT = 28,
  FG__AT_FIRST = 32,
  FG__AT_NODES = 44,
  FG__AT_OFFSET = 56,
  FG__AT_BYTES = 64,
  FG__AT_CHECKSUM = 72,
  FG__ELEMENT_FLOAT32 = 1 /* IEEE 754 binary32, the only kind so far */
};

static inline void fg__put_32(unsigned char *at, uint32_t value)
{
  for (int n = 0; n < 4; ++n)
    at[n] = (unsigned char)(value >> (8 * n));
}

static inline void fg__put_64(unsigned char *at, uint64_t value)
{
  fg__put_32(at, (uint32_t)value);
  fg__put_32(at + 4, (uint32_t)(value >> 32));
}

static inline uint32_t fg__get_32(const unsigned char *at)
{
  uint32_t value = 0;
  for (int n = 0; n < 4; ++n)
    value |= (uint32_t)at[n] << (8 * n);
  return value;
}

static inline uint64_t fg__get_64(const unsigned char *at)
{
  return fg__get_32(at) | (uint64_t)fg__get_32(at + 4) << 32;
}

#endif
