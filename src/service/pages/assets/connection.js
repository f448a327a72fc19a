"use strict";
// A request that outlives its connection: it is sent again, with longer and longer pauses and at once when the browser is
// back on the network, until it is answered. `send` makes the request anew each time. `waits` is told when there is
// no answer: with that of a server that has no time, or with nothing where the connection is gone.
const untilAnswered = async (send, signal, waits) => {
  const LONGEST = 60_000; // milliseconds without an answer after which the connection counts as gone
  const LAST_PAUSE = 30; // seconds
  for (let pause = 1; ; pause = Math.min(2 * pause, LAST_PAUSE)) {
    let seconds = pause;
    try {
      const answer = await inTime(send, signal, LONGEST);
      if (![429, 502, 503, 504].includes(answer.status)) return answer;
      seconds = Math.min(Number(answer.headers.get("retry-after")) || pause, LAST_PAUSE);
      waits(answer);
    } catch (error) {
      if (signal.aborted) throw error;
      waits(undefined);
    }
    await backOnline(seconds, signal);
  }
};

const inTime = async (send, signal, longest) => {
  const controller = new AbortController();
  const abort = () => controller.abort();
  const timer = setTimeout(abort, longest);
  signal.addEventListener("abort", abort);
  try {
    return await send(controller.signal);
  } finally {
    clearTimeout(timer);
    signal.removeEventListener("abort", abort);
  }
};

// Some seconds, or as long as it takes until the browser says that it is back on the network.
const backOnline = (seconds, signal) => new Promise((done, stop) => {
  const end = (how) => () => {
    clearTimeout(timer);
    removeEventListener("online", back);
    signal.removeEventListener("abort", abort);
    how(new DOMException("stopped", "AbortError"));
  };
  const [back, abort] = [end(done), end(stop)];
  const timer = setTimeout(back, seconds * 1000);
  addEventListener("online", back);
  signal.addEventListener("abort", abort);
});
