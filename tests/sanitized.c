/* Linked to sanitized programs, so that the leak check tells MPI's and Cairo's leaks from
 * ours.
 *
 * What MPI has loaded stays loaded to the end: a stack then names its modules, and
 * scripts/lsan.supp goes by these. What MPI allocates where it starts and ends does not
 * count as a leak. Without that each allocation would have to record its whole stack, for
 * MPI is compiled without frame pointers; programs would take twice as long. Nor does
 * what Cairo and Fontconfig keep of fonts until the process ends: a suppression would
 * look up the functions on the way to it, which takes longer than a small picture. */
#define _GNU_SOURCE /* for RTLD_NEXT */
#include <dlfcn.h>
#include <sanitizer/lsan_interface.h>

#pragma GCC visibility push(default)
int dlclose(void *handle);
int MPI_Init_thread(int *count, char ***arguments, int wanted, int *provided);
int MPI_Finalize(void);
void cairo_select_font_face(void *cairo, const char *family, int slant, int weight);
void cairo_text_extents(void *cairo, const char *text, void *extents);
#pragma GCC visibility pop

/* MPI's own names of the same, absent from programs without MPI */
__attribute__((weak)) int PMPI_Init_thread(int *, char ***, int, int *);
__attribute__((weak)) int PMPI_Finalize(void);

int dlclose(void *handle)
{
  (void)handle;
  return 0;
}

int MPI_Init_thread(int *count, char ***arguments, int wanted, int *provided)
{
  __lsan_disable();
  const int status = PMPI_Init_thread(count, arguments, wanted, provided);
  __lsan_enable();
  return status;
}

int MPI_Finalize(void)
{
  __lsan_disable();
  const int status = PMPI_Finalize();
  __lsan_enable();
  return status;
}

/* Cairo's own function */
#define NEXT(function) ((__typeof__(&(function)))dlsym(RTLD_NEXT, #function))

void cairo_select_font_face(void *cairo, const char *family, int slant, int weight)
{
  __lsan_disable();
  NEXT(cairo_select_font_face)(cairo, family, slant, weight);
  __lsan_enable();
}

void cairo_text_extents(void *cairo, const char *text, void *extents)
{
  __lsan_disable();
  NEXT(cairo_text_extents)(cairo, text, extents);
  __lsan_enable();
}
