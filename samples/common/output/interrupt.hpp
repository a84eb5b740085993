// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_INTERRUPT_HPP
#define RSACKERMANN_SAMPLES_INTERRUPT_HPP

#include <stdexcept>

namespace rsackermann_samples {

//! Thrown to leave unfinished work because of a signal.
struct Interrupted : std::runtime_error
{
    Interrupted() : std::runtime_error("interrupted") {}
};

/** From now on the first SIGINT or SIGTERM asks the program to end in good order; a second one ends it at once. SIGXFSZ
is ignored, so that a limit on the size of files is an error of writing like a full disk. */
void listenForInterrupts();

//! The signal that has asked the program to end; 0: none.
int interruptSignal();

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_INTERRUPT_HPP
