/* What a NetCDF-4 file is made of, before libnetcdf opens it. libnetcdf follows every
 * link of HDF5: one that leads round makes it list the same groups again and again, one
 * that leads into another file makes it show that file's bytes. So all links and data
 * sets are looked at here first, with HDF5 itself, and no more than once each. */
#define H5_USE_110_API
#include <hdf5.h>

#include "base/memory.h"
#include "read/netcdf/netcdf.h"

#include <stdlib.h>
#include <string.h>

enum {
  MOST_OBJECTS = 1 << 15, /* data sets and groups; files of models have hundreds */
  DEEPEST = 64            /* groups within groups */
};

/* A chunk is in memory as a whole, twice while it is inflated. Writers make chunks of a
 * few megabytes. */
static const hsize_t LARGEST_CHUNK = (hsize_t)1 << 28;

/* Inflated data are at most 1032 times as large as stored ones (RFC 1951): what takes
 * less than this becomes no gigabyte. */
static const hsize_t SMALL_STORAGE = (hsize_t)1 << 20;

/* HDF5 1.10 looks for a chunk by its number in all of them: of more only the sum is
 * looked at. */
enum { CHUNKS_LOOKED_AT = 256 };

typedef struct walk {
  fg_context *context;
  const char *path;
  hid_t access; /* of links: those into other files are not followed */
  haddr_t *group;
  size_t groups, group_capacity;
  size_t objects;
  int depth;
  fg_status status;
} walk;

static fg_status refuse(walk *w, const char *name, const char *why)
{
  return fg__fail(w->context, FG_STATUS_UNSUPPORTED, "%s: '%.200s' %s", w->path, name,
                  why);
}

/* Filters make data larger by little: what is stored in far more bytes than it has when
 * it is read would be inflated to any size. */
static bool is_swollen(hsize_t stored, hsize_t bytes)
{
  return stored > SMALL_STORAGE && stored - SMALL_STORAGE > bytes + bytes / 8;
}

/* bytes: of a chunk in memory. */
static fg_status check_storage(walk *w, const char *name, hid_t set, hsize_t bytes)
{
  const hid_t space = H5Dget_space(set);
  hsize_t chunks = 0, stored = H5Dget_storage_size(set), all = stored;
  bool swollen = false;
  if (stored > SMALL_STORAGE && H5Dget_num_chunks(set, space, &chunks) >= 0) {
    swollen = chunks < SIZE_MAX / 2 / (bytes + 1) && is_swollen(all, chunks * bytes);
    for (hsize_t n = 0; n < chunks && chunks <= CHUNKS_LOOKED_AT && !swollen; ++n)
      swollen = H5Dget_chunk_info(set, space, n, NULL, NULL, NULL, &stored) >= 0 &&
                is_swollen(stored, bytes);
  }
  H5Sclose(space);
  return swollen ? refuse(w, name, "is stored in more bytes than it has") : FG_STATUS_OK;
}

static fg_status check_chunk(walk *w, const char *name, hid_t set, hid_t creation)
{
  hsize_t length[H5S_MAX_RANK];
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, length);
  const hid_t type = H5Dget_type(set);
  hsize_t bytes = H5Tget_size(type);
  H5Tclose(type);
  for (int k = 0; k < rank; ++k) {
    if (length[k] > 0 && bytes > LARGEST_CHUNK / length[k])
      return fg__fail(w->context, FG_STATUS_UNSUPPORTED,
                      "%s: '%.200s' is stored in pieces of more than %llu bytes", w->path,
                      name, (unsigned long long)LARGEST_CHUNK);
    bytes *= length[k];
  }
  return check_storage(w, name, set, bytes);
}

static fg_status check_set(walk *w, const char *name, hid_t set)
{
  const hid_t creation = H5Dget_create_plist(set);
  if (creation < 0)
    return FG_STATUS_OK; /* damaged: libnetcdf says it */
  fg_status status = FG_STATUS_OK;
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (H5Pget_external_count(creation) > 0)
    status = refuse(w, name, "is stored outside of the file");
  else if (layout == H5D_VIRTUAL)
    status = refuse(w, name, "is a virtual data set, put together of other files");
  else if (layout == H5D_CHUNKED)
    status = check_chunk(w, name, set, creation);
  H5Pclose(creation);
  return status;
}

static fg_status walk_group(walk *w, hid_t group);

/* Each group once: with two ways to each of thirty groups there are 2^30 ways. */
static fg_status enter_group(walk *w, const char *name, hid_t group, haddr_t address)
{
  for (size_t i = 0; i < w->groups; ++i)
    if (w->group[i] == address)
      return refuse(w, name, "is a group that another link leads to already");
  if (w->depth >= DEEPEST)
    return refuse(w, name, "lies too deep in groups within groups");
  void *grown = w->group;
  if (!fg__grow(&grown, &w->group_capacity, w->groups + 1, sizeof *w->group))
    return fg__fail_memory(w->context, "groups", (w->groups + 1) * sizeof *w->group);
  w->group = grown;
  w->group[w->groups++] = address;
  ++w->depth;
  fg_status status = walk_group(w, group);
  --w->depth;
  return status;
}

static fg_status check_object(walk *w, const char *name, hid_t object)
{
  H5O_info_t about;
  if (++w->objects > MOST_OBJECTS)
    return fg__fail(w->context, FG_STATUS_UNSUPPORTED,
                    "%s: has more than %d groups and variables", w->path, MOST_OBJECTS);
  if (H5Oget_info2(object, &about, H5O_INFO_BASIC) < 0)
    return FG_STATUS_OK;
  if (about.type == H5O_TYPE_GROUP)
    return enter_group(w, name, object, about.addr);
  return about.type == H5O_TYPE_DATASET ? check_set(w, name, object) : FG_STATUS_OK;
}

static herr_t check_link(hid_t group, const char *name, const H5L_info_t *link,
                         void *data)
{
  walk *w = data;
  w->status = fg__check_stop(w->context);
  if (w->status == FG_STATUS_OK && link->type != H5L_TYPE_HARD &&
      link->type != H5L_TYPE_SOFT)
    w->status = refuse(w, name, "is a link into another file");
  if (w->status == FG_STATUS_OK) {
    const hid_t object = H5Oopen(group, name, w->access);
    if (object >= 0) {
      w->status = check_object(w, name, object);
      H5Oclose(object);
    }
  }
  return w->status == FG_STATUS_OK ? 0 : 1;
}

static fg_status walk_group(walk *w, hid_t group)
{
  H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, check_link, w);
  return w->status;
}

static herr_t follow_no_further(const char *parent_file, const char *parent_group,
                                const char *file, const char *object, unsigned *flags,
                                hid_t access, void *data)
{
  (void)parent_file, (void)parent_group, (void)file, (void)object;
  (void)flags, (void)access, (void)data;
  return -1;
}

static fg_status check_file(walk *w, hid_t file)
{
  w->access = H5Pcreate(H5P_LINK_ACCESS);
  H5Pset_elink_cb(w->access, follow_no_further, NULL);
  const hid_t root = H5Oopen(file, "/", H5P_DEFAULT);
  fg_status status = FG_STATUS_OK;
  if (root >= 0) {
    status = check_object(w, "/", root);
    H5Oclose(root);
  }
  H5Pclose(w->access);
  free(w->group);
  return status;
}

/* Below 0: what HDF5 does not open, libnetcdf does not either. */
static hid_t open_file(const fg__source *source)
{
  if (source->on_disk)
    return H5Fopen(source->path, H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, (size_t)1 << 16, false);
  H5Pset_file_image(access, (void *)(uintptr_t)source->bytes, source->size);
  const hid_t file = H5Fopen("memory", H5F_ACC_RDONLY, access);
  H5Pclose(access);
  return file;
}

fg_status fg__nc_check_objects(fg_context *context, const fg__source *source)
{
  H5E_auto2_t print;
  void *print_data;
  H5Eget_auto2(H5E_DEFAULT, &print, &print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  walk w = {.context = context, .path = source->path};
  fg_status status = FG_STATUS_OK;
  const hid_t file = open_file(source);
  if (file >= 0) {
    status = check_file(&w, file);
    H5Fclose(file);
  }
  H5Eset_auto2(H5E_DEFAULT, print, print_data);
  return status;
}
