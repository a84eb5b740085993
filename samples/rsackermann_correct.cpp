// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Undoes the rolling shutter of images and videos that a car's camera has taken.

#include "correct/batch.hpp"
#include "estimator_options.hpp"
#include "output/interrupt.hpp"
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace rsackermann_samples;

const char* const ABOUT =
    "Undoes the rolling shutter of images and videos that a car's camera has taken.\n"
    "usage: rsackermann_correct [--option=value]... [--] INPUT...\n"
    "INPUT is an image, a video, a folder of images, a printf pattern of image names or @FILE with one name per line.\n"
    "Images and videos are files, no pipes.\n"
    "Exit code: 0 all is done, 1 some inputs failed, 2 the command line isn't understood, 130 or 143 interrupted.\n";

// Images come and go. To have their memory from the system anew each time takes as long as to decode them.
void keepMemory()
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    mallopt(M_TRIM_THRESHOLD, 1 << 28);
#endif
}

int run(const Options& options)
{
    keepMemory();
    listenForInterrupts();
    const Job job = readJob(options);
    return Batch(job).run();
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(JOB_KEYS) + PRIOR_KEYS + GYRO_KEYS + DETECTOR_KEY + CAMERA_KEYS, run, argc,
                      argv);
}
