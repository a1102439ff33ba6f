/* NetCDF files: classic, 64-bit offset, CDF-5 and NetCDF-4, through NetCDF-C. */
#ifndef FG__NETCDF_H
#define FG__NETCDF_H

#include "decode/openers.h"

#include <stdint.h>

/* Compares the size of a file with what its header promises. FILE_FORMAT. */
fg_status fg__nc_check_size(fg_context *context, const fg__source *source);

/* A chunk whose content has been checked: the index of its first sample. */
typedef struct fg__nc_checked_chunk {
  const fg__variable *variable;
  uint64_t place[FG__RANK];
} fg__nc_checked_chunk;

/* A NetCDF-4 file as HDF5 sees it, open where chunks have to be checked before they are
 * read (chunks.c). */
enum { FG__NC_CHECKED_CHUNKS = 64 };
typedef struct fg__nc_storage {
  bool is_open;
  int64_t file; /* hid_t */
  fg__nc_checked_chunk checked[FG__NC_CHECKED_CHUNKS];
  size_t next;
} fg__nc_storage;

/* Deflate makes at most 1032 bytes of one (RFC 1951), so that a chunk of at most so many
 * stored bytes inflates to a gigabyte at most. */
#define FG__NC_HARMLESS_BYTES ((uint64_t)1 << 20)

/* Whether a chunk takes far more bytes in the file than in memory. */
bool fg__nc_is_overlong(uint64_t stored, uint64_t bytes);

/* Refuses a NetCDF-4 file whose links form a cycle, that refers to data in other files,
 * or whose chunks take more than 256 MiB each. *out has to be closed, also after a
 * failure. UNSUPPORTED, MEMORY. */
fg_status fg__nc_check_objects(fg__nc_storage *out, fg_context *context,
                               const fg__source *source);
void fg__nc_storage_close(fg__nc_storage *storage);

/* A file that is open: the decoder's state. */
typedef struct fg__nc_state {
  bool is_open;
  int root; /* ncid */
  fg__nc_storage storage;
} fg__nc_state;

/* Reads a part of a variable as nc_get_vara_double does, few chunks at a time; start and
 * count have FG__RANK + 1 numbers. */
int fg__nc_get_numbers(const fg__variable *variable, const size_t *start,
                       const size_t *count, double *out);

/* Checks the chunks of a part that is to be read; indices are the file's. FILE_FORMAT
 * (one would become far larger in memory than the file says), MEMORY. */
fg_status fg__nc_check_chunks(const fg__variable *variable, const size_t *start,
                              const size_t *count);

#endif
