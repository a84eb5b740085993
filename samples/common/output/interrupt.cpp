// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "interrupt.hpp"

#include <csignal>

namespace rsackermann_samples {

namespace {

volatile std::sig_atomic_t received = 0;

void remember(int signal)
{
    received = signal;
}

} // namespace

void listenForInterrupts()
{
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = int(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    for (int signal : {SIGINT, SIGTERM})
    {
        // A shell makes programs in the background ignore SIGINT; that stays.
        struct sigaction present = {};
        if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

int interruptSignal()
{
    return received;
}

} // namespace rsackermann_samples
