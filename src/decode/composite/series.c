/* Lists of files with their times in JSON, as ParaView writes them beside the files:
 * {"file-series-version": "1.0", "files": [{"name": "a.vtu", "time": 0.5}, ...]}. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "base/memory.h"
#include "decode/composite/names.h"

static fg_status read_entry(fg__vtk_names *out, fg__vtk *vtk, const cJSON *entry, int n)
{
  const char *name =
      cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(entry, "name"));
  const cJSON *time = cJSON_GetObjectItemCaseSensitive(entry, "time");
  if (!name || (time && !(cJSON_IsNumber(time) && isfinite(time->valuedouble))))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: file %d of the list has no %s", vtk->path, n,
                    name ? "number as its time" : "name");
  char *file = fg__copy_text(name);
  return file ? fg__vtk_names_add(out, vtk, file, "", time ? time->valuedouble : n)
              : fg__fail_memory(vtk->context, "a file's name", strlen(name) + 1);
}

fg_status fg__vtk_names_of_series(fg__vtk_names *out, fg__vtk *vtk,
                                  const fg__source *source)
{
  cJSON *root = cJSON_ParseWithLength((const char *)source->bytes, source->size);
  const cJSON *files = cJSON_GetObjectItemCaseSensitive(root, "files"), *entry;
  fg_status status = FG_STATUS_OK;
  int n = 0;
  if (!cJSON_IsArray(files))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      root ? "%s: has no list \"files\"" : "%s: is not JSON", vtk->path);
  else
    cJSON_ArrayForEach(entry, files)
    {
      if (status == FG_STATUS_OK)
        status = read_entry(out, vtk, entry, n);
      ++n;
    }
  cJSON_Delete(root);
  return status;
}
