// The websocket: messages come in arrays, several in a frame; questions have an id.

const AGAIN = 1000; // ms after which a lost connection is tried again

/** The address of a websocket of this page, wherever the page is. */
export function socketAddress(name) {
  const address = new URL(name, document.baseURI);
  address.protocol = address.protocol.replace("http", "ws");
  address.hash = address.search = "";
  return address.href;
}

export class Socket {
  constructor(onMessage, onState) {
    this.onMessage = onMessage;
    this.onState = onState;
    this.waiting = new Map();
    this.lastId = 0;
    this.watched = null;
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(socketAddress("socket"));
    this.socket.onopen = () => {
      this.onState("connected");
      if (this.watched) this.send(this.watched);
    };
    this.socket.onmessage = (event) => {
      for (const message of JSON.parse(event.data)) this.take(message);
    };
    this.socket.onclose = () => {
      this.onState("lost");
      this.waiting.clear();
      setTimeout(() => this.connect(), AGAIN);
    };
  }

  take(message) {
    if (message.id === undefined) {
      this.onMessage(message);
    } else {
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    }
  }

  send(command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  /** Say what is looked at; said again after a lost connection. */
  watch(views, series, seeks) {
    const watched = { do: "watch", views, series, seeks };
    if (JSON.stringify(watched) === JSON.stringify(this.watched)) return;
    this.watched = watched;
    this.send(this.watched);
  }

  /** Ask a question; `answered` gets the answer, or nothing if the connection is lost. */
  ask(command, answered) {
    this.lastId += 1;
    this.waiting.set(this.lastId, answered);
    this.send({ ...command, id: this.lastId });
  }
}
