/** What the page asks for geometry: Keyline Studio's server, or the module within the page. */

export interface Failure {
  code: string;
  message: string;
  path?: string;
  hint?: string;
}

export type Answer<T> = { ok: true; result: T } | { ok: false; error: Failure };

export interface Session {
  version: string;
  folder: string;
  files: string[];
  kept: boolean;
}

export interface Exported {
  content: Blob;
  deviation: number;
  notes: string[];
}

export interface LongWork<T> {
  answer: Promise<Answer<T>>;
  /** The best found so far comes as the answer, where there is one. */
  cancel(): void;
}

export interface Client {
  /** Told whenever the other side was reached or was not. */
  onReach: (reached: boolean) => void;

  /** Formats a document can be written in, as extensions without their dot. */
  readonly formats: readonly string[];
  /** Whether there is such an operation; known once session() has answered. */
  can(op: string): boolean;

  /** What the page was opened with. */
  session(): Promise<Answer<Session>>;
  /** What a file of the session, or one that was uploaded, holds; null where it cannot be had. */
  given(file: string): Promise<Blob | null>;
  /** What keep() was last given; null: nothing. */
  kept(): Promise<unknown>;
  /** Whether it is kept beyond this page. */
  keep(text: string): Promise<boolean>;

  /** An operation, by a request of its own. */
  call<T>(op: string, request: object): Promise<Answer<T>>;
  /** An operation for what follows a hand. One by one, in order. */
  quick<T>(op: string, request: object): Promise<Answer<T>>;
  /** An operation that may take minutes: told how far it is, can be ended early. */
  long<T>(op: string, request: object, onProgress: (fraction: number, doing: string) => void): LongWork<T>;

  /** The name under which operations know the content from now on. */
  upload(name: string, content: Blob): Promise<Answer<string>>;
  /** Curves and surfaces as the file that is named. */
  export(request: object): Promise<Answer<Exported>>;
}
