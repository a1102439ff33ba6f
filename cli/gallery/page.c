/* The gallery's page: each figure with a description of the paper's, and its commands. */
#include <string.h>

#include "folder/files.h"
#include "gallery/gallery.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>flowgrain: the figures of Garcke et al. (2000)</title>\n<style>\n"
    "body{font:16px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;"
    "padding:0 1rem;color:#222}\n"
    "h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:3rem;border-top:1px solid #ccc;"
    "padding-top:1rem}\n"
    ".row{display:grid;gap:1rem;margin-bottom:1rem;"
    "grid-template-columns:repeat(var(--pictures),minmax(0,1fr))}\n"
    ".row.single{max-width:44rem}\n"
    "@media (max-width:45rem){.row{grid-template-columns:repeat(min(var(--pictures),2),"
    "minmax(0,1fr))}}\n"
    "figure{margin:0}\n"
    "img{width:100%;height:auto;border:1px solid #ddd}\n"
    "figcaption{font-size:.9rem;color:#444}\n"
    "pre{background:#f4f4f1;padding:.6rem;overflow-x:auto;font-size:.85rem}\n"
    ".paper{color:#444}\n</style>\n</head>\n<body>\n"
    "<h1>The figures of the paper, made by flowgrain</h1>\n"
    "<p>H. Garcke, T. Preu&szlig;er, M. Rumpf, A. Telea, U. Weikard and J. J. van Wijk: "
    "<em>A Continuous Clustering Method for Vector Fields</em>, IEEE Visualization 2000. "
    "Under each figure: what the paper shows there, what differs, and the commands that "
    "make it again, to be called in this folder. A number of clusters is the one asked "
    "for: the first snapshot with no more of them is shown. Clusters too small for an "
    "arrow "
    "have none.</p>\n";

/* Text with the three special characters of HTML escaped. */
static void print_text(FILE *page, const char *text)
{
  for (const char *c = text; *c; ++c)
    switch (*c) {
    case '&':
      fputs("&amp;", page);
      break;
    case '<':
      fputs("&lt;", page);
      break;
    case '>':
      fputs("&gt;", page);
      break;
    default:
      fputc(*c, page);
    }
}

static int count_pictures(const gallery_figure *figure)
{
  int count = 0;
  while (count < GALLERY_PICTURES && figure->picture[count].path)
    ++count;
  return count;
}

/* A build without 3D rendering has no picture; the page then says so. */
static void print_row(FILE *page, const char *folder, const gallery_picture *picture,
                      int count)
{
  fprintf(page, "<div class=\"row%s\" style=\"--pictures:%d\">\n",
          count == 1 ? " single" : "", count);
  for (int n = 0; n < count; ++n) {
    if (!file_is_there(folder, picture[n].path)) {
      fputs("<figure><figcaption>", page);
      print_text(page, picture[n].caption);
      fputs(": no picture, since this build has no pictures in 3D "
            "(FLOWGRAIN_RENDER=OFF)</figcaption></figure>\n",
            page);
      continue;
    }
    fprintf(page, "<figure><a href=\"%s\"><img src=\"%s\" alt=\"", picture[n].path,
            picture[n].path);
    print_text(page, picture[n].caption);
    fputs("\"></a><figcaption>", page);
    print_text(page, picture[n].caption);
    fputs("</figcaption></figure>\n", page);
  }
  fputs("</div>\n", page);
}

static void print_figure(FILE *page, const char *folder, const gallery_figure *figure)
{
  fprintf(page, "<h2 id=\"fig-%02d\">Figure", figure->number);
  if (figure->last)
    fprintf(page, "s %d and %d. ", figure->number, figure->last);
  else
    fprintf(page, " %d. ", figure->number);
  print_text(page, figure->title);
  fputs("</h2>\n", page);
  const int count = count_pictures(figure);
  for (int row = 0, first = 0; first < count; ++row) {
    int wanted = row < GALLERY_ROWS ? figure->row[row] : 0;
    int pictures = wanted && wanted < count - first ? wanted : count - first;
    print_row(page, folder, figure->picture + first, pictures);
    first += pictures;
  }
  fputs("<p class=\"paper\"><strong>In the paper:</strong> ", page);
  print_text(page, figure->paper);
  fputs("</p>\n", page);
  if (figure->differs) {
    fputs("<p><strong>Here:</strong> ", page);
    print_text(page, figure->differs);
    fputs("</p>\n", page);
  }
  if (!figure->command[0])
    return;
  fputs("<pre>", page);
  for (int n = 0; n < GALLERY_COMMANDS && figure->command[n]; ++n) {
    fputs("flowgrain ", page);
    print_text(page, figure->command[n]);
    fputc('\n', page);
  }
  fputs("</pre>\n", page);
}

bool gallery_shows(const gallery_figure *figure, int number)
{
  int last = figure->last ? figure->last : figure->number;
  return !number || (figure->number <= number && number <= last);
}

void gallery_print_page(FILE *page, const gallery_settings *settings)
{
  fputs(head, page);
  for (int n = 0; n < gallery_figure_count; ++n)
    if (gallery_shows(&gallery_figures[n], settings->figure))
      print_figure(page, settings->output, &gallery_figures[n]);
  fprintf(page, "<p class=\"paper\">flowgrain %s</p>\n</body>\n</html>\n", fg_version());
}
