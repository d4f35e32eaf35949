// The websocket of the work: files, guide and check. A question is a promise of its answer.

import { socketAddress } from "./socket.js";
import { text } from "./words.js";

const AGAIN = 1000; // ms after which a lost connection is tried again

export class Work {
  /** `hear` gets each message; `opened` is called after each connection. */
  constructor(hear, opened) {
    this.hear = hear;
    this.opened = opened;
    this.waiting = new Map();
    this.lastId = 0;
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(socketAddress("work"));
    this.socket.onopen = () => this.opened();
    this.socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      if (!message.id || message.kind) return this.hear(message);
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    };
    this.socket.onclose = () => {
      for (const answered of this.waiting.values()) answered({ error: text("lost") });
      this.waiting.clear();
      setTimeout(() => this.connect(), AGAIN);
    };
  }

  /** Ask; the answer has `error` if it could not be done. */
  ask(what, more = {}) {
    if (this.socket.readyState !== WebSocket.OPEN) return Promise.resolve({ error: text("lost") });
    this.lastId += 1;
    const id = this.lastId;
    this.socket.send(JSON.stringify({ do: what, id, ...more }));
    return new Promise((answered) => this.waiting.set(id, answered));
  }
}
