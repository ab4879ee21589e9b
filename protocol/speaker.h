// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who speaks for a scanner to one client, as the link between them sees it: for an emulated scanner
// its Session, for a real one whoever hands its words on. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "protocol/action.h"

namespace scipd::protocol {

class Speaker {
  public:
    Speaker() = default;
    Speaker(const Speaker&) = delete;
    Speaker& operator=(const Speaker&) = delete;
    virtual ~Speaker() = default;

    /// To be called before any bytes come. Longer requests are refused, each after it was told. Who
    /// reads no requests has no limit.
    virtual void limit_lines(std::size_t /*longest*/, std::function<void()> /*on_overlong*/) {}

    /// Too many requests wait for their answers: the shell must not read on until this is over.
    [[nodiscard]] virtual bool full() const = 0;
    /// Scans come, one after the other.
    [[nodiscard]] virtual bool streaming() const = 0;
    /// Something that the client has asked for is still to come.
    [[nodiscard]] virtual bool owes() const = 0;

    /// The next thing to be done, in order. Nothing: there is none at present.
    [[nodiscard]] virtual std::optional<Action> next_action() = 0;
    /// It can wait with what it says next, for a client that reads slowly.
    [[nodiscard]] virtual bool patient() const { return false; }
    /// It has said all that it ever will: the connection ends when that is sent.
    [[nodiscard]] virtual bool ended() const { return false; }
    /// The client has ended its side, and may still listen.
    virtual void end_of_input() {}

    /// The client is gone. What it began (stream, laser, adjust mode) ends as by QT and TM2. What
    /// it asked and what was to be sent is forgotten. What other clients began stays.
    virtual void close() = 0;
    /// What the client asked is forgotten, half a request too, and so is what was to be sent. What
    /// the client began goes on.
    virtual void forget() = 0;
};

}  // namespace scipd::protocol
