// Texts that the browser keeps from visit to visit. Where it keeps none, they last until the page is closed.

const texts = new Map<string, string>();
const prefix = "hemitex ";

export function kept(key: string): string | undefined {
  try {
    return texts.get(key) ?? localStorage.getItem(prefix + key) ?? undefined;
  } catch {
    return texts.get(key); // the browser forbids storage, for example for files on disk
  }
}

export function keep(key: string, text: string): void {
  texts.set(key, text);
  try {
    localStorage.setItem(prefix + key, text);
  } catch {
    // as above, or it is full
  }
}
