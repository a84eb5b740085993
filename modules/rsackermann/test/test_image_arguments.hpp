// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_IMAGE_ARGUMENTS_HPP
#define OPENCV_RSACKERMANN_TEST_IMAGE_ARGUMENTS_HPP

#include "test_common.hpp"
#include <cstring>
#include <functional>
#ifdef __unix__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace opencv_test {

//! An image whose last pixel is followed by memory that mustn't be read.
class GuardedImage
{
public:
    GuardedImage(const Size& size, int type)
    {
        const size_t bytes = size.area() * CV_ELEM_SIZE(type);
#ifdef __unix__
        const size_t page = (size_t)sysconf(_SC_PAGESIZE), pages = (bytes + page - 1) / page;
        length = (pages + 1) * page;
        memory = (uchar*)mmap(0, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        CV_Assert(memory != MAP_FAILED && mprotect(memory + pages * page, page, PROT_NONE) == 0);
        image = Mat(size, type, memory + pages * page - bytes);
#else
        image.create(size, type);
#endif
        std::memset(image.data, 1, bytes);
    }
    ~GuardedImage()
    {
#ifdef __unix__
        munmap(memory, length);
#endif
    }

    Mat image;

private:
    GuardedImage(const GuardedImage&);
    GuardedImage& operator=(const GuardedImage&);
    uchar* memory;
    size_t length;
};

//! A public function that takes an image.
struct Entry
{
    const char* name;
    bool detects; //!< segments or points are looked for, so that only types for that are accepted
    std::function<void(InputArray)> call;
};

//! Whether the image is accepted; an exception has to say what is expected.
inline bool isAccepted(const Entry& entry, InputArray image)
{
    try
    {
        entry.call(image);
        return true;
    }
    catch (const cv::Exception& e)
    {
        EXPECT_EQ(Error::StsBadArg, e.code) << e.what();
        EXPECT_NE(std::string::npos, e.err.find("expected")) << e.what();
        return false;
    }
}

// Images that an entry takes are read up to their last pixel, all others are refused with a reason.

inline void checkEveryType(const RollingShutterCamera& camera, const std::vector<Entry>& entries)
{
    const int depths[] = {CV_8U, CV_8S, CV_16U, CV_16S, CV_32S, CV_32F, CV_64F};
    for (const Entry& entry : entries)
        for (const int depth : depths)
            for (int channels = 1; channels <= 5; channels++)
            {
                SCOPED_TRACE(testing::Message() << entry.name << ", depth " << depth << ", channels " << channels);
                const GuardedImage guarded(camera.imageSize, CV_MAKETYPE(depth, channels));
                const bool isPicture = (depth == CV_8U || depth == CV_16U) && channels != 2 && channels != 5,
                           isRemapped = depth != CV_8S && depth != CV_32S;
                if (!entry.detects && channels == 5)
                    continue; // depends on the interpolation, and on the version of OpenCV
                EXPECT_EQ(entry.detects ? isPicture : isRemapped, isAccepted(entry, guarded.image));
            }
}

inline void checkEveryForm(const RollingShutterCamera& camera, const std::vector<Entry>& entries)
{
    const GuardedImage large(Size(80, 60), CV_8UC3);
    const int sizes3[] = {47, 61, 3};
    const Mat plain(camera.imageSize, CV_8UC3, Scalar::all(1)), cube(3, sizes3, CV_8U, Scalar::all(1));
    for (const Entry& entry : entries)
    {
        SCOPED_TRACE(entry.name);
        EXPECT_TRUE(isAccepted(entry, large.image(Rect(Point(19, 13), camera.imageSize)))) << "a part of an image";
        EXPECT_TRUE(isAccepted(entry, plain.getUMat(ACCESS_READ)));
        EXPECT_FALSE(isAccepted(entry, noArray()));
        EXPECT_FALSE(isAccepted(entry, Mat()));
        EXPECT_FALSE(isAccepted(entry, UMat()));
        EXPECT_FALSE(isAccepted(entry, cube));
        EXPECT_FALSE(isAccepted(entry, std::vector<Mat>(1, plain)));
        EXPECT_FALSE(isAccepted(entry, std::vector<Mat>()));
        if (std::string(entry.name) != "detectSegments")
        {
            EXPECT_FALSE(isAccepted(entry, large.image));
        }
    }
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_IMAGE_ARGUMENTS_HPP
