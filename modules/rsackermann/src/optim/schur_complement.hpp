// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_SCHUR_COMPLEMENT_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_SCHUR_COMPLEMENT_HPP

#include <Eigen/Core>

namespace cv { namespace rsackermann {

/** Elimination of the unknowns x from the normal equations

    A x + B y = -a,    B^T x + C y = -b,

of which (C - B^T A^-1 B) y = -(b - B^T A^-1 a) remains. */
template <class ByOthers, class Vector>
struct SchurComplement
{
    ByOthers byOthers; // A^-1 B
    Vector own;        // A^-1 a
    double gain;       // a^T A^-1 a: that of a step of x alone

    SchurComplement() : gain(0) {}
    SchurComplement(const ByOthers& inverseTimesB, const Vector& inverseTimesA, const Vector& a)
        : byOthers(inverseTimesB), own(inverseTimesA), gain(a.dot(own))
    {
    }

    //! Makes C and b those of the reduced equations.
    template <class Matrix, class Gradient>
    void reduce(const ByOthers& B, Matrix& C, Gradient& b) const
    {
        C -= B.transpose() * byOthers;
        b -= B.transpose() * own;
    }

    //! The eliminated unknowns that belong to a solution y of the reduced equations.
    template <class Others>
    Vector substitute(const Others& y) const
    {
        return -(own + byOthers * y);
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_SCHUR_COMPLEMENT_HPP
