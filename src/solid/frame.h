/* Frames along a polyline that do not twist. */
#ifndef FG__FRAME_H
#define FG__FRAME_H

/* Fills tangent[count] with unit tangents and normal[count] with unit normals that turn
 * about the tangent as little as can be: rotation-minimising, by double reflection (Wang,
 * Juettler, Zheng and Liu 2008, of fourth order). count is at least 2; points in a row
 * differ. */
void fg__frame_along(const double (*point)[3], int count, double (*tangent)[3],
                     double (*normal)[3]);

#endif
