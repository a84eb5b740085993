// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "slant_noise.hpp"

#include "slant_kernels.simd.hpp"
#include "single/slant_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

SlantSums sumSlants(const SlantArrays& slants, const SlantNoise& noise, double error)
{
    CV_CPU_DISPATCH(sumSlants, (slants, noise, error), CV_CPU_DISPATCH_MODES_ALL);
}

double slantLikelihood(const SlantArrays& slants, const SlantNoise& noise, double error)
{
    CV_CPU_DISPATCH(slantLikelihood, (slants, noise, error), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
