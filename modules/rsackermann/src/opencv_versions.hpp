// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPENCV_VERSIONS_HPP
#define OPENCV_RSACKERMANN_SRC_OPENCV_VERSIONS_HPP

// All that depends on the version of OpenCV and on how it is built: 4.6 to 5, inside of it or against an installed one.

#include "opencv2/core/hal/intrin.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/opencv_modules.hpp"
#ifdef HAVE_OPENCV_XIMGPROC
#include "opencv2/ximgproc.hpp"
#endif

// OpenCV doesn't install its private headers: a build against an installed OpenCV uses the public ones.
#ifdef __OPENCV_BUILD
#include "opencv2/core/private.hpp"
#else
#include "opencv2/core/utils/trace.hpp"
#define CV_INSTRUMENT_REGION() CV_TRACE_FUNCTION()
#endif

// The names that universal intrinsics have had since OpenCV 4.7, for the versions before.
#if CV_SIMD && !defined(CV_SIMD_SCALABLE)

namespace cv {
CV_CPU_OPTIMIZATION_HAL_NAMESPACE_BEGIN

template <typename V>
struct VTraits
{
    static inline int vlanes() { return V::nlanes; }
    enum { max_nlanes = V::nlanes };
};

#define RSACKERMANN_NAME_OPERATOR(name, op)                                                                            \
    template <typename V>                                                                                              \
    inline V name(const V& a, const V& b)                                                                              \
    {                                                                                                                  \
        return a op b;                                                                                                 \
    }
RSACKERMANN_NAME_OPERATOR(v_add, +)
RSACKERMANN_NAME_OPERATOR(v_sub, -)
RSACKERMANN_NAME_OPERATOR(v_mul, *)
RSACKERMANN_NAME_OPERATOR(v_div, /)
RSACKERMANN_NAME_OPERATOR(v_and, &)
RSACKERMANN_NAME_OPERATOR(v_or, |)
RSACKERMANN_NAME_OPERATOR(v_lt, <)
RSACKERMANN_NAME_OPERATOR(v_gt, >)
RSACKERMANN_NAME_OPERATOR(v_ge, >=)
RSACKERMANN_NAME_OPERATOR(v_le, <=)
#undef RSACKERMANN_NAME_OPERATOR

CV_CPU_OPTIMIZATION_HAL_NAMESPACE_END
} // namespace cv

#endif

// For an OpenCV without LSD: if neither cv nor cv::ximgproc has these names, lookup ends here.
struct NoLineSegmentDetector
{
    void detect(const cv::Mat&, std::vector<cv::Vec4f>&) const
    {
        CV_Error(cv::Error::StsNotImplemented,
                 "DETECTOR_LSD needs an OpenCV whose module imgproc or ximgproc has LineSegmentDetector");
    }
};
enum NoLineSegmentDetectorModes { LSD_REFINE_STD };
inline const NoLineSegmentDetector* createLineSegmentDetector(NoLineSegmentDetectorModes, double)
{
    static const NoLineSegmentDetector none = NoLineSegmentDetector();
    return &none;
}

namespace cv {
namespace ximgproc {
}
namespace rsackermann {

/** LSD of the module that has it, with its own coordinates.

It is in imgproc up to OpenCV 5.0 and is to move to ximgproc with the same names (opencv/opencv#29349,
opencv/opencv_contrib#4158).
*/
inline void detectLSDSegments(const Mat& gray, double scale, std::vector<Vec4f>& segments)
{
    using namespace cv::ximgproc;
    createLineSegmentDetector(LSD_REFINE_STD, scale)->detect(gray, segments);
}

}
} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPENCV_VERSIONS_HPP
