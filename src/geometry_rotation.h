// The rotation that takes points nearest to others, by Horn's unit quaternion.
#pragma once

namespace crestline {

// h: 3 x 3 by column, the sums of the products of the i-th co-ordinate of the points and the j-th
// of the others, both centred. r: the rotation by row; read by column it turns points that are
// rows.
void rotation_in_space(const double* h, double* r);

}  // namespace crestline
