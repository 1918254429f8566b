/** The server: one call for everything, a socket for what a hand is waiting for. */

import type { Answer, Client, Exported, Failure, LongWork, Session } from "./client.ts";

const kApi = "/api/v1/";
const kTokenKey = "keyline-token";
const kLost: Failure = {
  code: "io",
  message: "the server does not answer",
  hint: "your work is kept; start keyline studio again and open the address it prints",
};
const kUnknown: Failure = {
  code: "io",
  message: "The server does not know this page",
  hint: "open the address that keyline studio prints",
};

/** The token stands in the address, behind the mark that browsers never send, and stays in the tab. */
export function takeToken(location: Location, storage: Storage): string {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given) storage.setItem(kTokenKey, given);
  return given ?? storage.getItem(kTokenKey) ?? "";
}

export class ServerClient implements Client {
  private socket: Promise<WebSocket | null> | null = null;
  private readonly waiting = new Map<number, (answer: Answer<unknown>) => void>();
  private next = 1;
  onReach: (reached: boolean) => void = () => {};

  readonly formats = ["json", "svg", "dxf", "step", "iges", "csv", "pdf", "png", "html"];

  constructor(private readonly token: string) {}

  can(): boolean {
    return true; // a server that lacks one says so
  }

  /** Opens the socket before anything is asked for: the first curve waits for one thing less. */
  warm(): void {
    this.socket ??= this.open();
  }

  async session(): Promise<Answer<Session>> {
    const result = await this.get<Session>("studio/session");
    return result ? { ok: true, result } : { ok: false, error: kUnknown };
  }

  async given(file: string): Promise<Blob | null> {
    const reply = await this.ask(`studio/file?name=${encodeURIComponent(file)}`, {});
    return reply?.ok ? reply.blob() : null;
  }

  kept(): Promise<unknown> {
    return this.get<unknown>("studio/recovery");
  }

  private async get<T>(path: string): Promise<T | null> {
    const reply = await this.ask(path, {});
    if (!reply?.ok) return null;
    const text = await reply.text();
    return text ? (JSON.parse(text) as T) : null;
  }

  async call<T>(op: string, request: object): Promise<Answer<T>> {
    return this.post(op, JSON.stringify(request), "application/json");
  }

  async quick<T>(op: string, request: object): Promise<Answer<T>> {
    const socket = await (this.socket ??= this.open());
    if (!socket) return this.call(op, request);
    const id = this.next++;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve as (answer: Answer<unknown>) => void);
      socket.send(JSON.stringify({ ...request, op, id }));
    });
  }

  async upload(name: string, content: Blob): Promise<Answer<string>> {
    const answer = await this.post<never>(
      `studio/upload?name=${encodeURIComponent(name)}`, content, "application/octet-stream");
    if (!answer.ok) return answer;
    return { ok: true, result: (answer as unknown as { file: string }).file };
  }

  async keep(text: string): Promise<boolean> {
    return (await this.post("studio/recovery", text, "application/json")).ok;
  }

  async export(request: object): Promise<Answer<Exported>> {
    const report = "report" in request ? "?report=1" : ""; // on the lane of what takes long
    const reply = await this.ask(`studio/export${report}`, this.posting(JSON.stringify(request), "application/json"));
    if (!reply) return { ok: false, error: kLost };
    if (!reply.ok) return (await reply.json()) as Answer<never>;
    return {
      ok: true,
      result: {
        content: await reply.blob(),
        deviation: Number(reply.headers.get("Keyline-Deviation") ?? 0),
        notes: JSON.parse(reply.headers.get("Keyline-Notes") ?? "[]") as string[],
      },
    };
  }

  long<T>(op: string, request: object, onProgress: (fraction: number, doing: string) => void): LongWork<T> {
    const job = crypto.randomUUID();
    return {
      answer: this.follow<T>(op, request, job, onProgress),
      cancel: () => void this.call("cancel", { job }),
    };
  }

  private async follow<T>(op: string, request: object, job: string,
                          onProgress: (fraction: number, doing: string) => void): Promise<Answer<T>> {
    const posting = this.posting(JSON.stringify(request), "application/json", {
      Accept: "text/event-stream",
      "Keyline-Job": job,
    });
    const reply = await this.ask(op, posting);
    if (!reply?.body) return { ok: false, error: kLost };
    if (!reply.headers.get("Content-Type")?.startsWith("text/event-stream"))
      return (await reply.json()) as Answer<T>;
    try {
      for await (const { name, data } of eventsOf(reply.body)) {
        if (name === "answer") return JSON.parse(data) as Answer<T>;
        const told = JSON.parse(data) as { fraction: number; doing: string };
        onProgress(told.fraction, told.doing);
      }
    } catch {
      this.onReach(false);
    }
    return { ok: false, error: kLost };
  }

  private posting(body: BodyInit, type: string, more: Record<string, string> = {}): RequestInit {
    return { method: "POST", body, headers: { "Content-Type": type, ...more } };
  }

  private async post<T>(path: string, body: BodyInit, type: string): Promise<Answer<T>> {
    const reply = await this.ask(path, this.posting(body, type));
    if (!reply) return { ok: false, error: kLost };
    try {
      return (await reply.json()) as Answer<T>;
    } catch {
      return { ok: false, error: { code: "internal", message: `the server refused this (${reply.status})` } };
    }
  }

  private async ask(path: string, init: RequestInit): Promise<Response | null> {
    const headers = { ...(init.headers as Record<string, string>), Authorization: `Bearer ${this.token}` };
    try {
      const reply = await fetch(kApi + path, { ...init, headers });
      this.onReach(true);
      return reply;
    } catch {
      this.onReach(false);
      return null;
    }
  }

  private open(): Promise<WebSocket | null> {
    return new Promise((resolve) => {
      const url = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}${kApi}socket`;
      const socket = new WebSocket(url, ["keyline.v1", `token.${this.token}`]);
      socket.onopen = () => resolve(socket);
      socket.onmessage = (message) => this.take(message.data as string);
      socket.onclose = () => {
        this.socket = null;
        for (const answer of this.waiting.values()) answer({ ok: false, error: kLost });
        this.waiting.clear();
        resolve(null);
      };
    });
  }

  private take(text: string): void {
    const answer = JSON.parse(text) as Answer<unknown> & { id: number };
    const waiting = this.waiting.get(answer.id);
    this.waiting.delete(answer.id);
    waiting?.(answer);
  }
}

export interface ServerEvent {
  name: string;
  data: string;
}

/** Server-Sent Events out of a stream of bytes, as our server writes them. */
export async function* eventsOf(body: ReadableStream<Uint8Array>): AsyncGenerator<ServerEvent> {
  const reader = body.pipeThrough(new TextDecoderStream() as unknown as ReadableWritablePair<string, Uint8Array>).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    text += value;
    for (let end = text.indexOf("\n\n"); end >= 0; end = text.indexOf("\n\n")) {
      const lines = text.slice(0, end).split("\n");
      text = text.slice(end + 2);
      const field = (name: string) => lines.find((line) => line.startsWith(name))?.slice(name.length) ?? "";
      yield { name: field("event: "), data: field("data: ") };
    }
  }
}
