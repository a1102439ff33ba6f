/* The markup of a VTK XML file, by libxml2, and where its appended data lie. */
#include "base/memory.h"
#include "decode/vtk/document.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/parser.h>
#include <libxml/tree.h>

static const char APPENDED_OPEN[] = "<AppendedData";
static const char APPENDED_CLOSE[] = "</AppendedData";
static const char REPAIR[] = "</AppendedData></VTKFile>";

static size_t find_first(const unsigned char *bytes, size_t size, const char *text)
{
  size_t length = strlen(text), at = 0;
  while (at + length <= size) {
    const unsigned char *found = memchr(bytes + at, text[0], size - length + 1 - at);
    if (!found)
      break;
    at = (size_t)(found - bytes);
    if (memcmp(found, text, length) == 0)
      return at;
    ++at;
  }
  return size;
}

static size_t find_last(const unsigned char *bytes, size_t size, const char *text)
{
  size_t length = strlen(text);
  for (size_t at = size < length ? 0 : size - length + 1; at-- > 0;)
    if (bytes[at] == (unsigned char)text[0] && memcmp(bytes + at, text, length) == 0)
      return at;
  return size;
}

static bool is_space(unsigned char c)
{
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

/* Appended data may be raw bytes, which are no XML: the markup is cut before them.
 * *markup becomes the size of what remains; without appended data, all. */
static fg_status cut_appended(fg__vtk *vtk, const fg__source *source, size_t *markup)
{
  *markup = source->size;
  size_t open = find_first(source->bytes, source->size, APPENDED_OPEN);
  if (open == source->size)
    return FG_STATUS_OK;
  const unsigned char *close = memchr(source->bytes + open, '>', source->size - open);
  if (!close)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: ends inside the tag of its appended data, after %zu bytes",
                    vtk->path, source->size);
  if (close[-1] == '/')
    return FG_STATUS_OK;
  size_t at = (size_t)(close - source->bytes) + 1;
  *markup = at;
  while (at < source->size && is_space(source->bytes[at]))
    ++at;
  if (at == source->size || source->bytes[at] != '_')
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: the appended data do not begin with '_' at byte %zu", vtk->path,
                    at);
  vtk->appended = source->bytes + at + 1;
  vtk->appended_size = source->size - at - 1;
  vtk->appended_size = find_last(vtk->appended, vtk->appended_size, APPENDED_CLOSE);
  return FG_STATUS_OK;
}

/* libxml2 compares every attribute of a tag with every other one: a tag of megabytes
 * would take it hours. Those of VTK take a few hundred bytes. */
enum { LONGEST_TAG = 8192 };

/* Where the construct that begins at `at` ends; size when it does not. */
static size_t end_of_tag(const unsigned char *bytes, size_t size, size_t at)
{
  static const char *const skipped[][2] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  for (size_t i = 0; i < sizeof skipped / sizeof skipped[0]; ++i) {
    size_t length = strlen(skipped[i][0]);
    if (size - at >= length && memcmp(bytes + at, skipped[i][0], length) == 0)
      return at + length +
             find_first(bytes + at + length, size - at - length, skipped[i][1]);
  }
  unsigned char quote = 0;
  for (; at < size && (quote || bytes[at] != '>'); ++at)
    if (quote ? bytes[at] == quote : bytes[at] == '"' || bytes[at] == '\'')
      quote = quote ? 0 : bytes[at];
  return at;
}

static fg_status check_tags(const fg__vtk *vtk, const unsigned char *bytes, size_t size)
{
  size_t at = 0;
  while (at < size) {
    const unsigned char *tag = memchr(bytes + at, '<', size - at);
    if (!tag)
      break;
    size_t start = (size_t)(tag - bytes);
    at = end_of_tag(bytes, size, start);
    if (at - start > LONGEST_TAG && bytes[start + 1] != '!' && bytes[start + 1] != '?')
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: a tag of %zu bytes at byte %zu; at most %d can be read",
                      vtk->path, at - start, start, LONGEST_TAG);
  }
  return FG_STATUS_OK;
}

/* VTK files have no document type; XDMF's may, of which nothing is taken. Without one
 * there are no entities to expand. */
static void ignore_document_type(void *parser, const xmlChar *name,
                                 const xmlChar *external, const xmlChar *system)
{
  (void)name;
  (void)external;
  (void)system;
  (void)parser;
}

static void refuse_document_type(void *parser, const xmlChar *name,
                                 const xmlChar *external, const xmlChar *system)
{
  xmlParserCtxt *context = parser;
  ignore_document_type(parser, name, external, system);
  *(bool *)context->_private = true;
  xmlStopParser(context);
}

static fg_status parse(fg__vtk *vtk, const char *markup, size_t size)
{
  if (size > INT_MAX)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu bytes of markup; at most %d can be read", vtk->path, size,
                    INT_MAX);
  xmlParserCtxt *parser = xmlNewParserCtxt();
  if (!parser)
    return fg__fail_memory(vtk->context, "an XML parser", sizeof *parser);
  bool has_document_type = false;
  parser->_private = &has_document_type;
  parser->sax->internalSubset =
      vtk->may_have_document_type ? ignore_document_type : refuse_document_type;
  int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING;
  /* libxml2 takes a longer text for an attack unless it is told to expect one; inline
   * data may be one, and the memory it takes is the file's size */
  if (size > 10000000)
    options |= XML_PARSE_HUGE;
  xmlDoc *document = xmlCtxtReadMemory(parser, markup, (int)size, NULL, NULL, options);
  const xmlError *error = xmlCtxtGetLastError(parser);
  fg_status status = FG_STATUS_OK;
  if (has_document_type) {
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: has a document type, which a VTK file has not", vtk->path);
  } else if (error && error->code == XML_ERR_NO_MEMORY) {
    status = fg__fail_memory(vtk->context, "the markup", size);
  } else if (!document) {
    const char *message = error && error->message ? error->message : "no reason given";
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: line %d: not XML: %.*s",
                      vtk->path, error ? error->line : 0, (int)strcspn(message, "\n"),
                      message);
  }
  if (status == FG_STATUS_OK)
    vtk->document = document;
  else
    xmlFreeDoc(document);
  xmlFreeParserCtxt(parser);
  return status;
}

fg_status fg__vtk_parse(fg__vtk *vtk, const fg__source *source)
{
  size_t markup = 0;
  fg_status status = cut_appended(vtk, source, &markup);
  if (status == FG_STATUS_OK)
    status = check_tags(vtk, source->bytes, markup);
  if (status != FG_STATUS_OK)
    return status;
  if (!vtk->appended)
    return parse(vtk, (const char *)source->bytes, markup);
  char *repaired = fg__allocate(markup + sizeof REPAIR, 1);
  if (!repaired)
    return fg__fail_memory(vtk->context, "a file's markup", markup);
  memcpy(repaired, source->bytes, markup);
  memcpy(repaired + markup, REPAIR, sizeof REPAIR);
  status = parse(vtk, repaired, markup + sizeof REPAIR - 1);
  free(repaired);
  return status;
}

typedef struct offset_list {
  uint64_t *offset;
  size_t count, capacity;
} offset_list;

/* Collects the offsets of all elements that have one, wherever they are. */
static fg_status collect(offset_list *out, fg__vtk *vtk, const xmlNode *root)
{
  for (const xmlNode *node = root; node;) {
    char *text = node->type == XML_ELEMENT_NODE && !vtk->exhausted &&
                         fg__vtk_attribute_is(vtk, node, "format", "appended")
                     ? fg__vtk_attribute(vtk, node, "offset")
                     : NULL;
    if (text) {
      void *grown = out->offset;
      const bool good =
          fg__grow(&grown, &out->capacity, out->count + 1, sizeof *out->offset);
      out->offset = grown;
      if (good)
        out->offset[out->count++] = strtoull(text, NULL, 10);
      free(text);
      if (!good)
        return fg__fail_memory(vtk->context, "offsets", out->count * sizeof *out->offset);
    }
    const xmlNode *next = node->type == XML_ELEMENT_NODE ? node->children : NULL;
    for (; !next && node != root; node = node->parent)
      if ((next = node->next))
        break;
    node = next;
  }
  return FG_STATUS_OK;
}

static bool read_size(uint64_t *out, const fg__vtk *vtk, uint64_t at)
{
  if (at > vtk->appended_size || vtk->appended_size - at < vtk->header_bytes)
    return false;
  *out = fg__vtk_size(vtk, vtk->appended + at);
  return true;
}

/* Where the array at an offset ends; false where that is beyond the data. */
static bool find_end(uint64_t *end, const fg__vtk *vtk, uint64_t at)
{
  const uint64_t header = vtk->header_bytes;
  uint64_t number;
  if (!read_size(&number, vtk, at))
    return false;
  *end = at + header;
  if (vtk->compression == FG__VTK_PLAIN) {
    *end += number > vtk->appended_size ? vtk->appended_size + 1 : number;
    return *end <= vtk->appended_size;
  }
  const uint64_t blocks = number;
  if (blocks > vtk->appended_size / header)
    return false;
  *end += (2 + blocks) * header;
  for (uint64_t k = 0; k < blocks && *end <= vtk->appended_size; ++k) {
    if (!read_size(&number, vtk, at + (3 + k) * header) || number > vtk->appended_size)
      return false;
    *end += number;
  }
  return *end <= vtk->appended_size;
}

static bool are_blanks(const fg__vtk *vtk, uint64_t from)
{
  for (uint64_t at = from; at < vtk->appended_size; ++at)
    if (!is_space(vtk->appended[at]))
      return false;
  return true;
}

/* Bytes that were added or lost in the middle shift all numbers after them, and nothing
 * else shows it. */
fg_status fg__vtk_check_appended(fg__vtk *vtk)
{
  offset_list list = {.offset = NULL};
  uint64_t last = 0, end = 0;
  if (!vtk->appended || vtk->appended_base64 ||
      vtk->compression == FG__VTK_OTHER_COMPRESSION)
    return FG_STATUS_OK;
  fg_status status = collect(&list, vtk, xmlDocGetRootElement(vtk->document));
  for (size_t n = 0; n < list.count; ++n)
    last = list.offset[n] > last ? list.offset[n] : last;
  const bool some = list.count > 0;
  free(list.offset);
  /* of an offset beyond the data the array's reading tells */
  if (status != FG_STATUS_OK || !some || last > vtk->appended_size ||
      (find_end(&end, vtk, last) && are_blanks(vtk, end)))
    return status;
  return fg__fail(
      vtk->context, FG_STATUS_FILE_FORMAT,
      "%s: damaged: the last of its appended arrays, at offset %llu, does not "
      "end with the %zu bytes of appended data",
      vtk->path, (unsigned long long)last, vtk->appended_size);
}
