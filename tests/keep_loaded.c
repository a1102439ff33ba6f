/* Linked to sanitized programs: what MPI has loaded stays loaded to the end, so that the
 * leak check can name the modules of its stacks (scripts/lsan.supp goes by these). */
__attribute__((visibility("default"))) int dlclose(void *handle);

int dlclose(void *handle)
{
  (void)handle;
  return 0;
}
