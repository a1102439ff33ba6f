/* Checks the structure of a NetCDF-4 file before libnetcdf opens it. libnetcdf follows
 * every HDF5 link: it would list the groups of a cyclic link repeatedly, and would read
 * from another file through an external link; and it takes names of any length. All
 * links, data sets and names are therefore checked here first, with HDF5 itself, each
 * object once. */
#define H5_USE_110_API
#include <hdf5.h>

#include "base/memory.h"
#include "decode/netcdf/netcdf.h"

#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* libnetcdf takes half a second to open this number of objects. Model
 * output has hundreds of objects, and NetCDF had this bound of attributes once. */
enum {
  MOST_OBJECTS = 1 << 13,    /* data sets and groups */
  MOST_ATTRIBUTES = 1 << 13, /* of one object */
  DEEPEST = 64               /* groups within groups */
};

/* libnetcdf does not end names that are longer, and reads and writes beyond them. */
enum { LONGEST_NAME = NC_MAX_NAME - 1 };

/* A chunk is in memory as a whole, twice while it is inflated. Usual chunks have a few
 * megabytes. */
static const hsize_t LARGEST_CHUNK = (hsize_t)1 << 28;

/* HDF5 1.10 finds a chunk by its number with a search through all of them. With more
 * chunks than this, each is checked when it is read (chunks.c). */
enum { MOST_CHUNKS = 256 };

typedef struct walk {
  fg_context *context;
  const char *path;
  hid_t access; /* of links; external links are not followed */
  haddr_t *group;
  size_t groups, group_capacity;
  size_t objects;
  int depth;
  bool has_large; /* some chunks may become far too large */
  fg_status status;
} walk;

static fg_status refuse(walk *w, const char *name, const char *why)
{
  return fg__fail(w->context, FG_STATUS_UNSUPPORTED, "%s: '%.200s' %s", w->path, name,
                  why);
}

static fg_status check_name(walk *w, const char *name)
{
  const size_t length = strlen(name);
  return length <= LONGEST_NAME
             ? FG_STATUS_OK
             : fg__fail(w->context, FG_STATUS_UNSUPPORTED,
                        "%s: '%.40s...' is a name of %zu bytes; names of up to %d can be "
                        "read",
                        w->path, name, length, LONGEST_NAME);
}

static herr_t check_attribute(hid_t object, const char *name, const H5A_info_t *about,
                              void *data)
{
  (void)object, (void)about;
  walk *w = data;
  w->status = check_name(w, name);
  return w->status == FG_STATUS_OK ? 0 : 1;
}

static fg_status check_attributes(walk *w, const char *name, hid_t object, hsize_t count)
{
  if (count > MOST_ATTRIBUTES)
    return fg__fail(w->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%.200s' has %llu attributes; %d can be read", w->path, name,
                    (unsigned long long)count, MOST_ATTRIBUTES);
  w->status = FG_STATUS_OK;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, check_attribute, w);
  return w->status;
}

/* Filters enlarge data by little. A chunk that takes many more bytes in the file than in
 * memory is a forged stream, which HDF5 would inflate to any size. */
bool fg__nc_is_overlong(uint64_t stored, uint64_t bytes)
{
  return stored > FG__NC_HARMLESS_BYTES &&
         stored - FG__NC_HARMLESS_BYTES > bytes + bytes / 8;
}

/* bytes: size of a chunk in memory. */
static fg_status check_storage(walk *w, const char *name, hid_t set, hsize_t bytes)
{
  const hid_t space = H5Dget_space(set);
  hsize_t chunks = 0, stored = H5Dget_storage_size(set), all = stored;
  bool overlong = false;
  if (stored > FG__NC_HARMLESS_BYTES && H5Dget_num_chunks(set, space, &chunks) >= 0) {
    overlong =
        chunks < SIZE_MAX / 2 / (bytes + 1) && fg__nc_is_overlong(all, chunks * bytes);
    w->has_large = w->has_large || chunks > MOST_CHUNKS;
    for (hsize_t n = 0; n < chunks && chunks <= MOST_CHUNKS && !overlong; ++n) {
      if (H5Dget_chunk_info(set, space, n, NULL, NULL, NULL, &stored) < 0)
        continue;
      overlong = fg__nc_is_overlong(stored, bytes);
      w->has_large = w->has_large || stored > FG__NC_HARMLESS_BYTES;
    }
  }
  H5Sclose(space);
  return overlong ? refuse(w, name, "is stored in more bytes than it has") : FG_STATUS_OK;
}

/* Inflated sizes are checked before a chunk is read (chunks.c), for one stage of deflate
 * only; and nbit and scaleoffset make as many samples as their parameters say, which must
 * not exceed the `samples` of a chunk. */
static fg_status check_filters(walk *w, const char *name, hid_t creation, hsize_t samples)
{
  enum { SAMPLES = 2, SETTINGS = 20 }; /* H5Znbit.c, H5Zscaleoffset.c */
  const int filters = H5Pget_nfilters(creation);
  bool deflated = false;
  for (int n = 0; n < filters; ++n) {
    unsigned flags, setting[SETTINGS] = {0};
    size_t settings = SETTINGS;
    const H5Z_filter_t id =
        H5Pget_filter2(creation, (unsigned)n, &flags, &settings, setting, 0, NULL, NULL);
    if (deflated && id != H5Z_FILTER_FLETCHER32)
      return refuse(w, name, "is compressed by another filter after deflate");
    deflated = deflated || id == H5Z_FILTER_DEFLATE;
    if ((id == H5Z_FILTER_NBIT || id == H5Z_FILTER_SCALEOFFSET) && settings > SAMPLES &&
        setting[SAMPLES] > samples)
      return refuse(w, name, "has chunks of fewer samples than their filter says");
  }
  return FG_STATUS_OK;
}

static fg_status check_chunk(walk *w, const char *name, hid_t set, hid_t creation)
{
  hsize_t length[H5S_MAX_RANK];
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, length);
  const hid_t type = H5Dget_type(set);
  const hsize_t width = H5Tget_size(type);
  hsize_t bytes = width;
  H5Tclose(type);
  for (int k = 0; k < rank; ++k) {
    if (length[k] > 0 && bytes > LARGEST_CHUNK / length[k])
      return fg__fail(w->context, FG_STATUS_UNSUPPORTED,
                      "%s: '%.200s' is stored in pieces of more than %llu bytes", w->path,
                      name, (unsigned long long)LARGEST_CHUNK);
    bytes *= length[k];
  }
  const fg_status status =
      check_filters(w, name, creation, width ? bytes / width : bytes);
  return status == FG_STATUS_OK ? check_storage(w, name, set, bytes) : status;
}

static fg_status check_set(walk *w, const char *name, hid_t set)
{
  const hid_t creation = H5Dget_create_plist(set);
  if (creation < 0)
    return FG_STATUS_OK; /* damaged: libnetcdf reports it */
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

/* Visits each group once: with two links to each of thirty nested groups there are 2^30
 * paths. */
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
  if (H5Oget_info2(object, &about, H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS) < 0)
    return FG_STATUS_OK;
  const fg_status status = check_attributes(w, name, object, about.num_attrs);
  if (status != FG_STATUS_OK)
    return status;
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
  if (w->status == FG_STATUS_OK)
    w->status = check_name(w, name);
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

/* Negative: HDF5 cannot open the file, and neither can libnetcdf. */
static hid_t open_file(const fg__source *source)
{
  char name[64]; /* HDF5 treats two files in memory with one name as the same file */
  snprintf(name, sizeof name, "memory-%p", (const void *)source->bytes);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (source->on_disk) {
    /* with libnetcdf's driver HDF5 would recognise its open file and refuse the second
     * because of other access properties */
    H5Pset_fapl_stdio(access);
  } else {
    H5Pset_fapl_core(access, (size_t)1 << 16, false);
    H5Pset_file_image(access, (void *)(uintptr_t)source->bytes, source->size);
  }
  const hid_t file =
      H5Fopen(source->on_disk ? source->path : name, H5F_ACC_RDONLY, access);
  H5Pclose(access);
  return file;
}

void fg__nc_storage_close(fg__nc_storage *storage)
{
  if (storage->is_open)
    H5Fclose((hid_t)storage->file);
  *storage = (fg__nc_storage){0};
}

fg_status fg__nc_check_objects(fg__nc_storage *out, fg_context *context,
                               const fg__source *source)
{
  *out = (fg__nc_storage){0};
  H5E_auto2_t print;
  void *print_data;
  H5Eget_auto2(H5E_DEFAULT, &print, &print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  walk w = {.context = context, .path = source->path};
  fg_status status = FG_STATUS_OK;
  const hid_t file = open_file(source);
  if (file >= 0) {
    status = check_file(&w, file);
    *out = (fg__nc_storage){.is_open = true, .file = file};
    if (status != FG_STATUS_OK || !w.has_large)
      fg__nc_storage_close(out);
  }
  H5Eset_auto2(H5E_DEFAULT, print, print_data);
  return status;
}
